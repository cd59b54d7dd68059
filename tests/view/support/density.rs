//! Density of a display's pixels, as desktops announce it: XSETTINGS, version 0.5.

use super::display::Display;
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{ConnectionExt, CreateWindowAux, PropMode, WindowClass};
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;
use x11rb::{COPY_DEPTH_FROM_PARENT, COPY_FROM_PARENT, CURRENT_TIME};

x11rb::atom_manager! {
    Atoms: AtomsCookie {
        _XSETTINGS_S0, _XSETTINGS_SETTINGS,
    }
}

/// Manager of a display's settings, until it is dropped.
pub struct Density {
    connection: RustConnection,
    window: u32,
    atoms: Atoms,
}

impl Density {
    /// Announces `dots` dots per inch; 96 is normal.
    pub fn new(display: &Display, dots: u32) -> Self {
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
        let density = Self { connection, window, atoms };
        density.set(dots);
        density.connection.set_selection_owner(window, atoms._XSETTINGS_S0, CURRENT_TIME).unwrap().check().unwrap();
        density
    }

    /// Changes the number of dots per inch.
    pub fn set(&self, dots: u32) {
        // The data are little-endian words: serial number and number of settings; then the kind of the setting, an
        // integer, and the length of its name.
        let mut bytes = vec![0, 0, 0, 0];
        bytes.extend([dots, 1].map(u32::to_le_bytes).as_flattened());
        bytes.extend([0, 0, 7, 0]);
        bytes.extend(b"Xft/DPI\0");
        bytes.extend([dots, 1024 * dots].map(u32::to_le_bytes).as_flattened());
        let settings = self.atoms._XSETTINGS_SETTINGS;
        self.connection
            .change_property8(PropMode::REPLACE, self.window, settings, settings, &bytes)
            .unwrap()
            .check()
            .unwrap();
    }
}
