//! Orders that wait for their turn.

use super::studio::Order;
use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, TryRecvError};

/// Orders in their turn; of pictures to look at, the last alone counts.
pub struct Inbox {
    receiver: Receiver<Order>,
    waiting: VecDeque<Order>,
    /// Whether nobody sends any more.
    is_closed: bool,
}

impl Inbox {
    pub fn new(receiver: Receiver<Order>) -> Self {
        Self {
            receiver,
            waiting: VecDeque::new(),
            is_closed: false,
        }
    }

    /// Waits for the next order; `None` once there is none left and nobody sends any more.
    pub fn next(&mut self) -> Option<Order> {
        self.collect();
        loop {
            let order = match self.waiting.pop_front() {
                Some(order) => order,
                None => self.receiver.recv().ok()?,
            };
            self.collect();
            if order.is_file() || !self.is_superseded() {
                return Some(order);
            }
        }
    }

    /// Whether another picture to look at is asked for, or nobody looks any more.
    pub fn is_superseded(&mut self) -> bool {
        self.collect();
        self.is_closed || self.waiting.iter().any(|order| !order.is_file())
    }

    fn collect(&mut self) {
        loop {
            match self.receiver.try_recv() {
                Ok(order) => self.waiting.push_back(order),
                Err(TryRecvError::Empty) => return,
                Err(TryRecvError::Disconnected) => {
                    self.is_closed = true;
                    return;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::photo::{Easel, Photo};
    use super::super::studio::Task;
    use super::*;
    use glam::DVec2;
    use gpc::output::{Format, Picture, encode};
    use std::sync::mpsc::channel;

    fn easel() -> Easel {
        let png = encode(
            Format::Png8,
            &Picture::new([1, 1], &[[0.0; 4]]).unwrap(),
            &[],
        );
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), png.unwrap()).unwrap();
        Easel::new(Photo::open(file.path()).unwrap(), [1, 1])
    }

    #[test]
    fn the_last_picture_and_every_file_is_made() {
        let view = easel().view([1, 1], None, false, DVec2::ZERO);
        let look = |number| Order {
            number,
            task: Task::Photo(view.clone()),
        };
        let file = |number| Order {
            number,
            task: Task::PhotoFile(view.clone(), "a.png".into()),
        };
        let (sender, receiver) = channel();
        let mut inbox = Inbox::new(receiver);
        for order in [look(1), file(2), look(3), file(4)] {
            sender.send(order).unwrap();
        }
        let mut next = || inbox.next().map(|order| order.number);
        assert_eq!([next(), next(), next()], [Some(2), Some(3), Some(4)]);
        sender.send(look(5)).unwrap();
        assert_eq!(next(), Some(5));
        assert!(!inbox.is_superseded());
        sender.send(file(6)).unwrap();
        assert!(!inbox.is_superseded());
        sender.send(look(7)).unwrap();
        assert!(inbox.is_superseded());
        drop(sender);
        // Nobody looks any more, but files are for later.
        assert_eq!(inbox.next().map(|order| order.number), Some(6));
        assert!(inbox.next().is_none());
    }
}
