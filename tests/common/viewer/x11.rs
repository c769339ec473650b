//! What X11 shows of the viewer, and what a window manager and a file manager tell it.

use super::super::{decode_png, render_png};
use super::{PATIENCE, Viewer};
use std::path::Path;
use std::time::{Duration, Instant};
use x11rb::CURRENT_TIME;
use x11rb::connection::Connection;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    ClientMessageEvent, ConnectionExt, CreateWindowAux, EventMask, ImageFormat, PropMode,
    SELECTION_NOTIFY_EVENT, SelectionNotifyEvent, WindowClass,
};
use x11rb::wrapper::ConnectionExt as _;

impl Viewer {
    /// What the screen shows of a rectangle: left, top, width, height.
    pub fn screen(&self, [left, top]: [i16; 2], [width, height]: [u16; 2]) -> Vec<[u8; 3]> {
        let reply = self.connection.get_image(ImageFormat::Z_PIXMAP, self.root, left, top, width, height, !0);
        let data = reply.expect("a request").reply().expect("a screenshot").data;
        data.chunks_exact(4).map(|pixel| [pixel[2], pixel[1], pixel[0]]).collect()
    }

    /// The size of the picture that was shown last.
    pub fn picture_size(&self) -> [u16; 2] {
        let shown = self.last_shown.borrow();
        let size = shown.rsplit(' ').next().and_then(|size| size.split_once('x')).expect("a size");
        [size.0, size.1].map(|extent| extent.parse().expect("a number"))
    }

    /// What the screen shows of the picture, which stands at the right.
    pub fn picture(&self) -> Vec<[u8; 3]> {
        let size = self.picture_size();
        self.screen([(self.size[0] - size[0]).cast_signed(), 0], size)
    }

    /// Waits until the screen shows what `render` gives, but for `tolerance` levels of a channel.
    pub fn expect_picture(&self, what: &str, tolerance: u8, render: &[&str]) {
        self.expect_rows(what, usize::from(self.picture_size()[1]), tolerance, render);
    }

    /// Waits as [`Self::expect_picture`] does, but compares only the upper rows: there may be a legend below.
    pub fn expect_rows(&self, what: &str, rows: usize, tolerance: u8, render: &[&str]) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let [width, height] = self.picture_size();
        let size = format!("{width}x{height}");
        let expected = decode_png(&render_png(folder.path(), &[&["--size", &size], render].concat())).1;
        let deadline = Instant::now() + PATIENCE;
        let compared = rows * usize::from(width);
        loop {
            let shown = self.picture();
            let worst = difference(&shown[..compared], &expected[..compared]);
            if worst <= tolerance {
                break;
            }
            assert!(Instant::now() < deadline, "{what}: off by {worst} levels");
            self.listen(Duration::from_millis(50));
        }
    }

    fn atom(&self, name: &str) -> u32 {
        self.connection.intern_atom(false, name.as_bytes()).expect("a request").reply().expect("an atom").atom
    }

    /// Sends a message to every window of the display, of which the viewer's is the one that understands it.
    fn tell(&self, name: &str, data: [u32; 5]) {
        let message = self.atom(name);
        let windows =
            self.connection.query_tree(self.root).expect("a request").reply().expect("the windows").children;
        for window in windows {
            let event = ClientMessageEvent::new(32, window, message, data);
            self.connection.send_event(false, window, EventMask::NO_EVENT, event).expect("a request");
        }
        self.connection.flush().expect("a connection");
    }

    /// Drops a file on the window, as a file manager does by the XDND protocol.
    pub fn drop_file(&self, file: &Path) {
        let connection = &self.connection;
        let source = connection.generate_id().expect("an id");
        let plain = CreateWindowAux::new();
        let input_only = WindowClass::INPUT_ONLY;
        connection
            .create_window(0, source, self.root, -1, -1, 1, 1, 0, input_only, 0, &plain)
            .expect("a request");
        let (selection, uris) = (self.atom("XdndSelection"), self.atom("text/uri-list"));
        connection.set_selection_owner(source, selection, CURRENT_TIME).expect("a request");
        self.tell("XdndEnter", [source, 5 << 24, uris, 0, 0]);
        let copies = self.atom("XdndActionCopy");
        self.tell("XdndPosition", [source, 0, 500 << 16 | 300, CURRENT_TIME, copies]);
        let wanted = loop {
            if let Event::SelectionRequest(wanted) = connection.wait_for_event().expect("an event") {
                break wanted;
            }
        };
        let uri = format!("file://{}\r\n", file.display());
        let (window, property) = (wanted.requestor, wanted.property);
        connection
            .change_property8(PropMode::REPLACE, window, property, wanted.target, uri.as_bytes())
            .expect("a request");
        let answer = SelectionNotifyEvent {
            response_type: SELECTION_NOTIFY_EVENT,
            sequence: 0,
            time: wanted.time,
            requestor: window,
            selection,
            target: wanted.target,
            property,
        };
        connection.send_event(false, window, EventMask::NO_EVENT, answer).expect("a request");
        self.tell("XdndDrop", [source, 0, CURRENT_TIME, 0, 0]);
        connection.destroy_window(source).expect("a request");
        connection.flush().expect("a connection");
    }

    /// Asks the window to close, as a window manager does, waits for the end, and returns the rest of the log.
    pub fn close(mut self) -> Vec<String> {
        self.tell("WM_PROTOCOLS", [self.atom("WM_DELETE_WINDOW"), 0, 0, 0, 0]);
        let deadline = Instant::now() + PATIENCE;
        let status = loop {
            if let Some(status) = self.program.0.try_wait().expect("a process") {
                break status;
            }
            assert!(Instant::now() < deadline, "it does not close");
            std::thread::sleep(Duration::from_millis(10));
        };
        let log: Vec<String> = self.lines.iter().collect();
        assert!(!log.iter().any(|line| line.contains("validation:")), "{log:#?}");
        assert!(status.success(), "{status}: {log:#?}");
        log
    }
}

/// The largest difference of a channel.
pub fn difference(a: &[[u8; 3]], b: &[[u8; 3]]) -> u8 {
    assert_eq!(a.len(), b.len());
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0)
}
