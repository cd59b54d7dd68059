//! A host that works in the library's device, and the pictures that it gets, whatever way it lends what it has.

mod base;
mod behind;
mod blend;
mod completion;
mod lent;
mod list;
mod machine;
mod mask;
mod rounds;
mod world;
