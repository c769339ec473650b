//! Rendering without a window, and reading the images back.

use super::film::FilmImages;
use super::schedule::Stage;
use super::{Pace, Progress, Renderer};
use crate::error::Result;
use crate::vulkan::{Buffer, Commands, Image, Recording, Residence};
use std::time::Duration;

/// How long the device works on a headless submission: far less than the time after which desktop drivers stop one.
const HEADLESS_BUDGET: Duration = Duration::from_millis(100);

/// Images are read back in parts of about this many bytes, because the largest images do not fit into one buffer.
const READ_AT_ONCE: u64 = 1 << 26;

impl Renderer {
    /// Renders until the target is reached. `on_progress` is called after every submission.
    pub fn render(&mut self, on_progress: impl FnMut(&Progress)) -> Result<()> {
        let pace = Pace { budget: HEADLESS_BUDGET, preview: false };
        self.render_at(pace, on_progress)
    }

    /// Renders until the target is reached, at this pace. `on_progress` is called after every submission.
    pub fn render_at(&mut self, pace: Pace, mut on_progress: impl FnMut(&Progress)) -> Result<()> {
        let mut commands = Commands::new(&self.preparer.device)?;
        while !self.finished() {
            let mut recording = commands.begin()?;
            self.record(&mut recording, 0, pace);
            recording.submit()?;
            commands.wait()?;
            self.collect(0)?;
            on_progress(&self.progress());
        }
        Ok(())
    }

    /// The film: the mean r, g, b and the number of samples of each pixel, row by row from the top left.
    pub fn read_film(&mut self) -> Result<Vec<[f32; 4]>> {
        let bytes = self.read_image(
            |images| &images.film,
            |renderer, recording| renderer.record_clear(recording, true),
        )?;
        Ok(bytemuck::allocation::pod_collect_to_vec(&bytes))
    }

    /// The picture: r, g, b and 255 of each pixel in sRGB, row by row from the top left.
    pub fn read_picture(&mut self) -> Result<Vec<u8>> {
        self.read_image(
            |images| &images.picture,
            |renderer, recording| renderer.record_resolve_as(recording, false),
        )
    }

    /// Finishes a batch that is partly merged into the film, so that all pixels have the samples of whole batches.
    pub fn settle(&mut self) -> Result<()> {
        let mut commands = Commands::new(&self.preparer.device)?;
        let mut recording = commands.begin()?;
        recording.barrier();
        while let Some(cursor) = self.standing.cursor.filter(|cursor| cursor.stage == Stage::Accumulate) {
            let tile = self.tile(cursor, u64::MAX, true);
            self.record_tile(&mut recording, &tile);
        }
        recording.submit()?;
        commands.wait()
    }

    /// A copy of the picture as it is now.
    pub fn hold_picture(&mut self) -> Result<Image> {
        let held = Image::rgba8(&self.preparer.device, "held picture", self.picture().extent())?;
        let mut commands = Commands::new(&self.preparer.device)?;
        let mut recording = commands.begin()?;
        recording.clear(&held);
        recording.barrier();
        self.record_resolve(&mut recording);
        recording.copy_to_image(self.picture(), &held);
        recording.submit()?;
        commands.wait()?;
        Ok(held)
    }

    /// Reads an image back, after the commands that `prepare` records.
    fn read_image(
        &mut self,
        choose: impl FnOnce(&FilmImages) -> &Image,
        prepare: impl FnOnce(&mut Self, &mut Recording<'_>),
    ) -> Result<Vec<u8>> {
        let mut commands = Commands::new(&self.preparer.device)?;
        let mut recording = commands.begin()?;
        recording.barrier();
        prepare(self, &mut recording);
        recording.submit()?;
        commands.wait()?;
        let image = choose(&self.loaded.images);
        let [_, height] = image.extent();
        let row = image.byte_len() / u64::from(height);
        let rows = u32::try_from(READ_AT_ONCE / row).unwrap_or(height).clamp(1, height);
        let buffer =
            Buffer::new(&self.preparer.device, "read-back", row * u64::from(rows), Residence::Staging)?;
        let mut bytes = Vec::with_capacity(usize::try_from(image.byte_len()).unwrap_or(0));
        for first in (0..height).step_by(rows as usize) {
            let count = rows.min(height - first);
            let mut recording = commands.begin()?;
            recording.copy_rows(image, first, count, &buffer);
            recording.submit()?;
            commands.wait()?;
            bytes.extend_from_slice(&buffer.bytes()[..row as usize * count as usize]);
        }
        Ok(bytes)
    }
}
