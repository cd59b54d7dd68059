//! Dropping of files on a window, as file managers do it: the source's side of XDND, version 5.

use super::PATIENCE;
use super::display::Display;
use std::path::Path;
use std::time::Instant;
use x11rb::connection::Connection;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    Atom, ClientMessageEvent, ConnectionExt, CreateWindowAux, EventMask, PropMode, SELECTION_NOTIFY_EVENT,
    SelectionNotifyEvent, SelectionRequestEvent, WindowClass,
};
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;
use x11rb::{COPY_DEPTH_FROM_PARENT, COPY_FROM_PARENT, CURRENT_TIME};

x11rb::atom_manager! {
    Atoms: AtomsCookie {
        XdndSelection, XdndEnter, XdndPosition, XdndStatus, XdndDrop, XdndFinished, XdndActionCopy,
        URI_LIST: b"text/uri-list",
    }
}

/// A program that drags files.
struct Source {
    connection: RustConnection,
    window: u32,
    target: u32,
    uris: String,
}

/// Drops a file or folder on the window with this number.
pub fn drop_file(display: &Display, target: u32, path: &Path) {
    let (connection, screen) = RustConnection::connect(Some(&display.name)).unwrap();
    let atoms = Atoms::new(&connection).unwrap().reply().unwrap();
    let window = connection.generate_id().unwrap();
    let root = connection.setup().roots[screen].root;
    connection
        .create_window(
            COPY_DEPTH_FROM_PARENT,
            window,
            root,
            0,
            0,
            1,
            1,
            0,
            WindowClass::INPUT_OUTPUT,
            COPY_FROM_PARENT,
            &CreateWindowAux::new(),
        )
        .unwrap();
    connection.set_selection_owner(window, atoms.XdndSelection, CURRENT_TIME).unwrap();
    let source = Source { connection, window, target, uris: format!("file://{}\r\n", path.display()) };
    source.send(atoms.XdndEnter, [5 << 24, atoms.URI_LIST, 0, 0]);
    let place = 100 << 16 | 100;
    source.send(atoms.XdndPosition, [0, place, CURRENT_TIME, atoms.XdndActionCopy]);
    source.serve_until(atoms.XdndStatus);
    source.send(atoms.XdndDrop, [0, CURRENT_TIME, 0, 0]);
    source.serve_until(atoms.XdndFinished);
}

impl Source {
    fn send(&self, kind: Atom, [a, b, c, d]: [u32; 4]) {
        let message = ClientMessageEvent::new(32, self.target, kind, [self.window, a, b, c, d]);
        self.connection.send_event(false, self.target, EventMask::NO_EVENT, message).unwrap();
        self.connection.flush().unwrap();
    }

    /// Answers requests for the paths until the window sends a message of this kind.
    fn serve_until(&self, kind: Atom) {
        let until = Instant::now() + PATIENCE;
        loop {
            match self.connection.poll_for_event().unwrap() {
                Some(Event::SelectionRequest(request)) => self.hand_over(&request),
                Some(Event::ClientMessage(message)) if message.type_ == kind => return,
                Some(_) => {}
                None => {
                    assert!(Instant::now() < until, "the window answers no drag");
                    std::thread::sleep(std::time::Duration::from_millis(20));
                }
            }
        }
    }

    fn hand_over(&self, request: &SelectionRequestEvent) {
        self.connection
            .change_property8(
                PropMode::REPLACE,
                request.requestor,
                request.property,
                request.target,
                self.uris.as_bytes(),
            )
            .unwrap();
        let notify = SelectionNotifyEvent {
            response_type: SELECTION_NOTIFY_EVENT,
            sequence: 0,
            time: request.time,
            requestor: request.requestor,
            selection: request.selection,
            target: request.target,
            property: request.property,
        };
        self.connection.send_event(false, request.requestor, EventMask::NO_EVENT, notify).unwrap();
        self.connection.flush().unwrap();
    }
}
