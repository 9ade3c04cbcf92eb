//! Pictures encoded for a terminal's own protocol, on a thread of its own.

use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread;

use image::{DynamicImage, ImageBuffer, Rgb};
use ratatui::layout::{Rect, Size};
use ratatui_image::picker::ProtocolType;
use ratatui_image::protocol::{Protocol, iterm2::Iterm2, kitty::Kitty, sixel::Sixel};

use super::screen::{Screen, Way};
use super::{Paint, Slot, Stamp};
use crate::experiment::results::Picture;

/// A picture somebody wants encoded.
#[derive(Clone)]
pub struct Wish {
    /// Where it is shown.
    pub slot: Slot,
    /// What it shows.
    pub stamp: Stamp,
    /// What paints it.
    pub paint: Arc<dyn Paint>,
    /// Cells it covers, across and down.
    pub size: Size,
}

/// A picture as the terminal takes it.
pub struct Encoded {
    /// Where it is shown.
    pub slot: Slot,
    /// What it shows.
    pub stamp: Stamp,
    /// Cells it covers, across and down.
    pub size: Size,
    /// The picture; none if it cannot be encoded.
    pub protocol: Option<Protocol>,
}

/// Encodes what is wished for, the latest wish of each slot only.
pub struct Encoder {
    mailbox: Arc<Mailbox>,
}

#[derive(Default)]
struct Mailbox {
    wishes: Mutex<Wishes>,
    arrived: Condvar,
}

#[derive(Default)]
struct Wishes {
    /// At most one a slot, in the order the slots were first wished for.
    waiting: Vec<Wish>,
    closed: bool,
}

impl Encoder {
    /// Starts the thread; what it makes goes to `deliver`, on that thread.
    pub fn start(screen: Screen, deliver: impl Fn(Encoded) + Send + 'static) -> Self {
        let mailbox = Arc::new(Mailbox::default());
        let theirs = Arc::clone(&mailbox);
        thread::spawn(move || {
            let mut count = 0;
            while let Some(wish) = theirs.next() {
                count += 1;
                deliver(encode(&wish, &screen, count));
            }
        });
        Self { mailbox }
    }

    /// Wishes for an encoding, in place of the one still waiting for the same slot. Never waits for a painter.
    pub fn request(&self, wish: Wish) {
        let mut wishes = self.mailbox.lock();
        match wishes.waiting.iter_mut().find(|waiting| waiting.slot == wish.slot) {
            Some(waiting) => *waiting = wish,
            None => wishes.waiting.push(wish),
        }
        drop(wishes);
        self.mailbox.arrived.notify_one();
    }
}

impl Drop for Encoder {
    /// Lets the thread go; it ends when its present picture is done.
    fn drop(&mut self) {
        self.mailbox.lock().closed = true;
        self.mailbox.arrived.notify_one();
    }
}

impl Mailbox {
    fn lock(&self) -> std::sync::MutexGuard<'_, Wishes> {
        self.wishes.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next wish, waited for; none once the sender is gone.
    fn next(&self) -> Option<Wish> {
        let idle = |wishes: &mut Wishes| wishes.waiting.is_empty() && !wishes.closed;
        let waited = self.arrived.wait_while(self.lock(), idle);
        let mut wishes = waited.unwrap_or_else(PoisonError::into_inner);
        if wishes.closed { None } else { Some(wishes.waiting.remove(0)) }
    }
}

/// Kitty numbers its pictures; a number used again is the old picture gone. Those of one slot are used in turn, more of
/// them than a gallery keeps.
pub(super) const KITTY_TURNS: u32 = 16;

/// The first of a slot's numbers: unlikely ones, as other programs may have drawn on the same terminal.
pub(super) fn kitty_number(slot: Slot, turn: u32) -> u32 {
    0x0077_0000 + u32::from(slot.0) * KITTY_TURNS + turn % KITTY_TURNS
}

fn encode(wish: &Wish, screen: &Screen, count: u32) -> Encoded {
    let area = Rect::new(0, 0, wish.size.width, wish.size.height);
    let painted = wish.paint.paint(screen.pixels(area), screen.aspect());
    let image = enlarged(&painted, screen.full(area));
    let number = kitty_number(wish.slot, count);
    let protocol = image.and_then(|image| protocol(image, wish.size, screen, number));
    Encoded { slot: wish.slot, stamp: wish.stamp, size: wish.size, protocol }
}

fn protocol(image: DynamicImage, size: Size, screen: &Screen, number: u32) -> Option<Protocol> {
    let Way::Protocol(kind) = screen.way else { return None };
    let tmux = screen.tmux;
    match kind {
        ProtocolType::Kitty => {
            Kitty::new(image, size, number, tmux, screen.inflates).ok().map(Protocol::Kitty)
        }
        ProtocolType::Sixel => Sixel::new(image, size, tmux).ok().map(Protocol::Sixel),
        ProtocolType::Iterm2 => Iterm2::new(image, size, tmux).ok().map(Protocol::ITerm2),
        ProtocolType::Halfblocks => None,
    }
}

/// The picture at the screen's own pixels, those painted repeated; none if there are none.
fn enlarged(picture: &Picture, [width, height]: [usize; 2]) -> Option<DynamicImage> {
    if picture.rgb.is_empty() || picture.rgb.len() != picture.width * picture.height {
        return None;
    }
    let at = |x: u32, y: u32| {
        let (x, y) = (x as usize * picture.width / width, y as usize * picture.height / height);
        Rgb(picture.rgb[y * picture.width + x])
    };
    Some(ImageBuffer::from_fn(width as u32, height as u32, at).into())
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;
    use std::time::Duration;

    use super::super::{Depth, Flat};
    use super::*;

    fn screen(kind: ProtocolType) -> Screen {
        Screen { way: Way::Protocol(kind), cell: [5, 10], ..Screen::plain(Depth::True) }
    }

    fn wish(slot: u8, version: u64, paint: Arc<dyn Paint>) -> Wish {
        let stamp = Stamp { picture: 1, version };
        Wish { slot: Slot(slot), stamp, paint, size: Size::new(4, 3) }
    }

    fn grey() -> Arc<dyn Paint> {
        let (width, height) = (2, 2);
        Arc::new(Flat(Arc::new(Picture { width, height, rgb: vec![[90; 3]; 4] })))
    }

    #[test]
    fn every_protocol_covers_the_cells_asked_for() {
        for kind in [ProtocolType::Kitty, ProtocolType::Sixel, ProtocolType::Iterm2] {
            let made = encode(&wish(0, 1, grey()), &screen(kind), 1);
            assert_eq!(made.protocol.expect("encoded").size(), Size::new(4, 3), "{kind:?}");
        }
    }

    /// Tells that it was begun, then waits to be let go.
    struct Slow(mpsc::Sender<()>, Mutex<mpsc::Receiver<()>>);

    impl Paint for Slow {
        fn paint(&self, [width, height]: [usize; 2], _: f64) -> Picture {
            self.0.send(()).unwrap();
            self.1.lock().unwrap().recv().unwrap();
            Picture { width, height, rgb: vec![[1; 3]; width * height] }
        }
    }

    #[test]
    fn the_latest_wish_of_a_slot_wins() {
        let (begun, is_begun) = mpsc::channel();
        let (go, may_go) = mpsc::channel();
        let (made, results) = mpsc::channel();
        let encoder = Encoder::start(screen(ProtocolType::Kitty), move |encoded| {
            made.send((encoded.slot, encoded.stamp.version)).unwrap();
        });
        encoder.request(wish(0, 1, Arc::new(Slow(begun, Mutex::new(may_go)))));
        is_begun.recv().unwrap();
        for version in 2..=9 {
            encoder.request(wish(0, version, grey()));
        }
        encoder.request(wish(1, 5, grey()));
        go.send(()).unwrap();
        let next = || results.recv_timeout(Duration::from_secs(60)).unwrap();
        assert_eq!([next(), next(), next()], [(Slot(0), 1), (Slot(0), 9), (Slot(1), 5)]);
    }

    #[test]
    fn what_cannot_be_encoded_is_told() {
        let empty = Wish { size: Size::new(0, 3), ..wish(0, 1, grey()) };
        assert!(encode(&empty, &screen(ProtocolType::Sixel), 1).protocol.is_none());
    }
}
