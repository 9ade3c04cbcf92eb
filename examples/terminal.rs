//! The terminal and pictures alone, to see what a terminal makes of them: `cargo run --example terminal`.
//!
//! It shows a picture, the last event and how pictures are drawn. `q` quits, Ctrl-Z suspends, `p` opens a popup, `x`
//! panics on a thread, `s` ignores signals to end. An argument is what `--pictures` would be.

use std::sync::{Arc, mpsc};
use std::thread;

use clap::ValueEnum;
use crossterm::event::{Event, KeyCode, KeyModifiers};
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::widgets::{Block, Clear, Paragraph};
use wrinkle::experiment::results::Picture;
use wrinkle::render::heat;
use wrinkle::tui::picture::{
    Colours, Encoded, Encoder, Flat, Gallery, Paint, Pictures, Slot, Stamp, probe,
};
use wrinkle::tui::terminal::{Input, Notice, Options, Session, draw, watch};

enum Message {
    Event(std::io::Result<Event>),
    Notice(Notice),
    Encoded(Encoded),
}

fn main() -> std::process::ExitCode {
    match run() {
        Ok(code) => code.into(),
        Err(error) => {
            eprintln!("error: {error}");
            2.into()
        }
    }
}

/// A picture of 256 by 128 colours.
fn colours() -> Arc<dyn Paint> {
    let at =
        |i: usize| heat((i % 256) as f64 / 255.0).map(|c| (usize::from(c) * (i / 256) / 127) as u8);
    Arc::new(Flat(Arc::new(Picture {
        width: 256,
        height: 128,
        rgb: (0..256 * 128).map(at).collect(),
    })))
}

fn run() -> Result<u8, Box<dyn std::error::Error>> {
    let pictures = std::env::args().nth(1);
    let pictures = pictures.map_or(Ok(Pictures::Auto), |name| Pictures::from_str(&name, true))?;
    let session = Session::start(Options { title: "wrinkle".into(), mouse: false })?;
    let screen = probe(pictures, Colours::Auto);
    let (sender, messages) = mpsc::channel();
    let to = |sender: &mpsc::Sender<Message>| sender.clone();
    let (events, notices, encodings) = (to(&sender), to(&sender), to(&sender));
    watch(move |notice| drop(notices.send(Message::Notice(notice))))?;
    let encoder = Encoder::start(screen, move |e| drop(encodings.send(Message::Encoded(e))));
    let input = Input::start(move |event| drop(events.send(Message::Event(event))));
    let mut terminal = session.terminal()?;
    let gallery = Gallery::new(screen);
    let (paint, mut last, mut popup, mut deaf) = (colours(), "none".to_owned(), false, false);
    loop {
        // The frame is as large as we say: a terminal may tell nonsense.
        let (columns, rows) = crossterm::terminal::size()?;
        if terminal.get_frame().area().as_size() != (columns, rows).into() {
            terminal.resize(Rect::new(0, 0, columns, rows))?;
        }
        let stamp = Stamp { picture: 1, version: 1 };
        draw(&mut terminal, |frame| {
            let rows = Layout::vertical([Constraint::Length(2), Constraint::Fill(1)]);
            let [top, below] = rows.areas(frame.area());
            let line = format!(
                "last event: {last}\n{:?} {:?} {:?}",
                screen.way,
                screen.depth,
                frame.area()
            );
            frame.render_widget(Paragraph::new(line), top);
            let window = Rect::new(6, 5, 20, 4).intersection(frame.area());
            gallery.cover(popup.then_some(window));
            gallery.show(Slot(0), stamp, &paint, below, frame.buffer_mut());
            if popup {
                frame.render_widget(Clear, window);
                frame.render_widget(Paragraph::new("a popup").block(Block::bordered()), window);
            }
            screen.depth.limit(frame.buffer_mut());
        })?;
        gallery.take_wishes().into_iter().for_each(|wish| encoder.request(wish));
        match messages.recv()? {
            Message::Encoded(encoded) => gallery.hang(encoded),
            Message::Notice(Notice::Quit(_)) if deaf => {}
            Message::Notice(Notice::Quit(signal)) => return Ok(signal.exit_code()),
            Message::Notice(Notice::Suspend) => drop(session.suspend(&input)?),
            Message::Notice(Notice::Continued) => {
                session.retake()?;
                gallery.forget();
                terminal.clear()?;
                last = "continued".into();
            }
            Message::Event(event) => match event? {
                Event::Key(key) => match key.code {
                    KeyCode::Char('q') => break,
                    KeyCode::Char('z') if key.modifiers == KeyModifiers::CONTROL => {
                        last = format!("suspended: {}", session.suspend(&input)?);
                    }
                    KeyCode::Char('p') => popup = !popup,
                    KeyCode::Char('x') => drop(thread::spawn(|| panic!("asked for"))),
                    KeyCode::Char('s') => (deaf, last) = (true, "deaf".into()),
                    code => last = format!("{code}"),
                },
                Event::Resize(..) => gallery.forget(),
                other => last = format!("{other:?}"),
            },
        }
    }
    print!("{}", gallery.farewell());
    Ok(0)
}
