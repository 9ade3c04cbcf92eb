//! The thread that reads reports and their files.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

use super::{Order, Told};
use crate::experiment::results::Picture;
use crate::render::{Film, read_image};
use crate::tui::library;

/// Hears what the thread tells.
pub type Tell = Arc<dyn Fn(Told) + Send + Sync>;

/// The thread that reads.
pub struct Worker {
    orders: Sender<Order>,
}

impl Worker {
    /// Starts it; reports are in `reports`.
    pub fn start(tell: Tell, reports: PathBuf) -> Self {
        let (orders, inbox) = channel();
        thread::spawn(move || work(&inbox, &tell, &reports));
        Self { orders }
    }

    /// Passes an order on; never waits.
    pub fn order(&self, order: Order) {
        // A thread that is gone has panicked, and the program is ending.
        let _ = self.orders.send(order);
    }
}

fn work(inbox: &Receiver<Order>, tell: &Tell, reports: &Path) {
    let mut waiting = VecDeque::new();
    while let Some(order) = waiting.pop_front().or_else(|| inbox.recv().ok()) {
        match order {
            Order::List => tell(Told::Listed(library::reports(reports))),
            Order::Open(folder) => tell(Told::Opened(Box::new(library::open(&folder)))),
            Order::Plot(ticket, path) => tell(Told::Plot(ticket, plot(&path).map(Arc::new))),
            Order::Films(ticket, files) => {
                for (place, path) in files {
                    waiting.extend(inbox.try_iter());
                    // Somebody who has gone on wants the rest no more.
                    if waiting.iter().any(|order| !matches!(order, Order::List)) {
                        break;
                    }
                    tell(Told::Film(ticket, place, film(&path).map(Arc::new)));
                }
            }
        }
    }
}

/// An image's luminance: its only channel, or the mean of its channels.
fn film(path: &Path) -> Result<Film, String> {
    let image = read_image(path).map_err(|error| error.to_string())?;
    let mut channels = image.channels;
    if channels.len() == 1 {
        return Ok(channels.remove(0));
    }
    let Some(first) = channels.first() else {
        return Err(format!("{}: it has no channels", path.display()));
    };
    let count = channels.len() as f32;
    let mean = |i: usize| channels.iter().map(|c| c.pixels()[i]).fold(0.0, |a, b| a + b) / count;
    let pixels = (0..first.pixels().len()).map(mean).collect();
    Ok(Film::new(first.width(), first.height(), pixels))
}

fn plot(path: &Path) -> Result<Picture, String> {
    let cannot = |error: &dyn std::fmt::Display| {
        format!("{}: cannot read the plot: {error}", path.display())
    };
    let reader = image::ImageReader::open(path).map_err(|error| cannot(&error))?;
    let reader = reader.with_guessed_format().map_err(|error| cannot(&error))?;
    let rgb = reader.decode().map_err(|error| cannot(&error))?.to_rgb8();
    let (width, height) = (rgb.width() as usize, rgb.height() as usize);
    Ok(Picture { width, height, rgb: rgb.pixels().map(|pixel| pixel.0).collect() })
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    fn told(orders: Vec<Order>, count: usize) -> Vec<Told> {
        let (sender, told) = channel();
        let tell: Tell = Arc::new(move |t| drop(sender.send(t)));
        let worker = Worker::start(tell, PathBuf::from("no-such-folder"));
        orders.into_iter().for_each(|order| worker.order(order));
        (0..count).map(|_| told.recv_timeout(Duration::from_secs(60)).unwrap()).collect()
    }

    #[test]
    fn a_film_comes_back_and_a_truncated_one_is_a_sentence() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        let film = Film::new(3, 2, vec![0.0, 0.5, 1.0, 1.5, 2.0, 2.5]);
        film.write_exr(&path).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let half = folder.path().join("half.exr");
        std::fs::write(&half, &bytes[..bytes.len() / 2]).unwrap();
        let gone = folder.path().join("gone.exr");
        let files = vec![(0, path), (1, half), (4, gone)];
        let told = told(vec![Order::Films(7, files)], 3);
        assert!(matches!(&told[0], Told::Film(7, 0, Ok(read)) if **read == film));
        let Told::Film(7, 1, Err(half)) = &told[1] else { panic!("{told:?}") };
        let Told::Film(7, 4, Err(gone)) = &told[2] else { panic!("{told:?}") };
        assert!(half.contains("half.exr: cannot read the image"), "{half}");
        assert!(gone.contains("gone.exr: cannot read the image"), "{gone}");
    }

    #[test]
    fn a_plot_that_is_none_is_a_sentence() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        std::fs::write(&path, b"\x89PNG\r\n\x1a\n and no more").unwrap();
        let told = told(vec![Order::Plot(1, path), Order::List], 2);
        assert!(
            matches!(&told[0], Told::Plot(1, Err(text)) if text.contains("cannot read the plot"))
        );
        assert!(matches!(&told[1], Told::Listed(none) if none.is_empty()));
    }
}
