//! Actions of keys, and the list that the window shows.

use super::look::Look;
use super::navigate::Side;
use super::overlay::Overlay;
use gpc::camera::zoom::{Shape, Transition};
use gpc::render::MethodKind;
use winit::keyboard::{Key, ModifiersState, NamedKey};

/// Action of a key or of a control in the panel.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    Help,
    Panel,
    FullScreen,
    ShowAll,
    LookFrom(Side),
    NextCamera,
    Fly,
    PreviousScene,
    NextScene,
    Reload,
    SetMethod(MethodKind),
    /// Gives the picture with this index another antialiasing.
    SetLook(usize, Box<Look>),
    MoreSamples,
    FewerSamples,
    Split,
    Magnify,
    Lens,
    AddLens,
    RemoveLens,
    /// Changes outline and transition of the active lens.
    SetLens(Shape, Transition),
    Tint,
    Unzoom,
    NextOverlay,
    /// Shows an overlay, or colours again.
    ShowOverlay(Option<Overlay>),
    Screenshot,
    CopyCommand,
    PlayOrPause,
    Slower,
    Faster,
    /// Shows a time of the animation, in seconds.
    Seek(f64),
    /// Plays the animation with this index.
    PlayAnimation(usize),
    Back,
    Quit,
}

/// A key with or without Control, and its action.
struct KeyBinding {
    key: Pressed,
    control: bool,
    /// Label of the key in the list.
    label: &'static str,
    action: Action,
    does: &'static str,
}

enum Pressed {
    Named(NamedKey),
    Text(&'static str),
}

const fn text(key: &'static str, label: &'static str, action: Action, does: &'static str) -> KeyBinding {
    KeyBinding { key: Pressed::Text(key), control: false, label, action, does }
}

const fn named(key: NamedKey, label: &'static str, action: Action, does: &'static str) -> KeyBinding {
    KeyBinding { key: Pressed::Named(key), control: false, label, action, does }
}

/// Bindings of all keys.
static BINDINGS: [KeyBinding; 35] = [
    text("h", "H", Action::Help, "list the keys"),
    text("p", "P", Action::Panel, "show or hide the panel"),
    named(NamedKey::F11, "F11", Action::FullScreen, "fill the screen that the window is on, or leave it"),
    named(NamedKey::Enter, "Enter", Action::ShowAll, "show the whole scene"),
    text("1", "1", Action::LookFrom(Side::Front), "look from the front"),
    text("3", "3", Action::LookFrom(Side::Right), "look from the right"),
    text("7", "7", Action::LookFrom(Side::Top), "look from above"),
    text("9", "9", Action::LookFrom(Side::Corner), "look from a corner"),
    text("c", "C", Action::NextCamera, "next camera of the scene"),
    text("f", "F", Action::Fly, "fly: WASD, arrows, E, Q; drag to look, wheel for speed"),
    text("s", "S", Action::SetMethod(MethodKind::Superpixel), "superpixels"),
    text("n", "N", Action::SetMethod(MethodKind::None), "no antialiasing"),
    text("m", "M", Action::SetMethod(MethodKind::Msaa), "the device's multisampling"),
    text("b", "B", Action::SetMethod(MethodKind::Ssaa), "brute force: supersampling"),
    text("+", "+", Action::MoreSamples, "more samples"),
    text("-", "-", Action::FewerSamples, "fewer samples"),
    text("x", "X", Action::Split, "split between two methods; drag the line"),
    text("l", "L", Action::Magnify, "magnifier: 8, 16, 32 times, off"),
    text("z", "Z", Action::Lens, "zoom lens: click, drag its radius, wheel"),
    text("a", "A", Action::AddLens, "one more lens at the pointer"),
    named(NamedKey::Delete, "Delete", Action::RemoveLens, "remove the lens at hand"),
    text("t", "T", Action::Tint, "colour the transitions of lenses"),
    text("u", "U", Action::Unzoom, "unzoom an image of gpc zoom under the pointer"),
    text("o", "O", Action::NextOverlay, "depth, IDs, normals, superpixels, triangles, error ..."),
    named(NamedKey::Space, "Space", Action::PlayOrPause, "play or pause the animation"),
    text("[", "[", Action::Slower, "play slower"),
    text("]", "]", Action::Faster, "play faster"),
    named(NamedKey::ArrowLeft, "Left", Action::PreviousScene, "previous scene"),
    named(NamedKey::ArrowRight, "Right", Action::NextScene, "next scene"),
    named(NamedKey::ArrowUp, "Up", Action::Reload, "load the scene again"),
    named(NamedKey::F12, "F12", Action::Screenshot, "write the picture with all samples to a file"),
    KeyBinding {
        key: Pressed::Text("c"),
        control: true,
        label: "Ctrl+C",
        action: Action::CopyCommand,
        does: "copy the command that makes this picture",
    },
    named(NamedKey::F1, "F1", Action::Help, "list the keys"),
    named(NamedKey::Escape, "Esc", Action::Back, "stop loading, writing or flying, or close the list"),
    text("q", "Q", Action::Quit, "quit"),
];

/// Actions of the mouse for the list: gesture and effect.
pub const MOUSE: [(&str, &str); 7] = [
    ("Left drag", "turn around the target"),
    ("Shift + left drag, middle drag", "move sideways"),
    ("Shift + wheel, shift + two fingers", "the same with a touchpad"),
    ("Wheel, two fingers, pinch", "zoom to the pointer"),
    ("Right drag", "zoom"),
    ("Double click", "bring what is under the pointer into the middle"),
    ("Drop a file or folder", "open it"),
];

/// Action of a key, if it has one.
pub fn action(key: &Key, modifiers: ModifiersState) -> Option<Action> {
    let is_pressed = |binding: &&KeyBinding| {
        let pressed = match (&binding.key, key) {
            (Pressed::Named(named), Key::Named(key)) => named == key,
            (Pressed::Text(text), Key::Character(key)) => key.to_lowercase() == *text,
            _ => false,
        };
        pressed && binding.control == modifiers.control_key()
    };
    BINDINGS.iter().find(is_pressed).map(|binding| binding.action.clone())
}

/// Rows of the list: the keys, and what they do.
pub fn list() -> impl Iterator<Item = (&'static str, &'static str)> {
    BINDINGS.iter().map(|binding| (binding.label, binding.does))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_has_one_meaning() {
        let mut labels: Vec<_> = list().map(|(label, _)| label).collect();
        labels.sort_unstable();
        labels.dedup();
        assert_eq!(labels.len(), BINDINGS.len());
        for binding in &BINDINGS {
            let key = match binding.key {
                Pressed::Named(named) => Key::Named(named),
                Pressed::Text(text) => Key::Character(text.to_uppercase().into()),
            };
            let modifiers = if binding.control { ModifiersState::CONTROL } else { ModifiersState::empty() };
            assert_eq!(action(&key, modifiers), Some(binding.action.clone()));
        }
    }

    #[test]
    fn other_keys_have_none() {
        let key = Key::Character("h".into());
        assert_eq!(action(&key, ModifiersState::CONTROL), None);
        assert_eq!(action(&Key::Named(NamedKey::F5), ModifiersState::empty()), None);
    }
}
