//! The event loop, on a display that responds.

use winit::error::EventLoopError;
use winit::event_loop::EventLoop;

/// Makes the event loop. In ssh, tmux and containers, the environment variables of Wayland can outlive the compositor.
/// If no compositor responds, this uses X11, if there is one. winit looks at the variables alone, and refuses to make a
/// second event loop after the first one has failed.
pub(super) fn event_loop() -> Result<EventLoop<()>, EventLoopError> {
    let mut builder = EventLoop::builder();
    #[cfg(any(
        target_os = "linux",
        target_os = "freebsd",
        target_os = "dragonfly",
        target_os = "netbsd",
        target_os = "openbsd"
    ))]
    if wayland::is_named() && is_set("DISPLAY") && !wayland::responds() {
        log::info!("no Wayland compositor answers; the window is opened by X11");
        winit::platform::x11::EventLoopBuilderExtX11::with_x11(&mut builder);
    }
    builder.build()
}

#[cfg(unix)]
fn is_set(variable: &str) -> bool {
    std::env::var_os(variable).is_some_and(|value| !value.is_empty())
}

#[cfg(unix)]
mod wayland {
    use super::is_set;
    use std::io::{Read, Write};
    use std::os::unix::fs::FileTypeExt;
    use std::os::unix::net::UnixStream;
    use std::path::{Path, PathBuf};
    use std::time::Duration;

    /// A compositor responds within milliseconds, or later if it is busy.
    const PATIENCE: Duration = Duration::from_secs(3);

    pub(super) fn is_named() -> bool {
        is_set("WAYLAND_DISPLAY") || is_set("WAYLAND_SOCKET")
    }

    /// Whether a compositor responds.
    pub(super) fn responds() -> bool {
        // A socket that was passed on already open takes precedence. It can be used only once, so it is not tried here.
        if let Some(number) = std::env::var_os("WAYLAND_SOCKET").filter(|number| !number.is_empty()) {
            let socket = std::fs::metadata(Path::new("/dev/fd").join(number));
            return socket.is_ok_and(|is| is.file_type().is_socket());
        }
        socket()
            .and_then(|path| UnixStream::connect(path).ok())
            .is_some_and(|stream| synchronize(stream).is_ok())
    }

    fn socket() -> Option<PathBuf> {
        let name = PathBuf::from(std::env::var_os("WAYLAND_DISPLAY")?);
        if name.is_absolute() {
            return Some(name);
        }
        Some(PathBuf::from(std::env::var_os("XDG_RUNTIME_DIR")?).join(name))
    }

    /// Sends the request `sync` (number 0) to the display (object 1): it creates a callback (object 2), which the
    /// compositor signals once it has handled all requests before it. See "Wire Format" in the Wayland protocol.
    fn synchronize(mut stream: UnixStream) -> std::io::Result<()> {
        stream.set_read_timeout(Some(PATIENCE))?;
        stream.set_write_timeout(Some(PATIENCE))?;
        let sync: [u32; 3] = [1, 12 << 16, 2];
        stream.write_all(&sync.map(u32::to_ne_bytes).concat())?;
        stream.read_exact(&mut [0; 8])
    }
}
