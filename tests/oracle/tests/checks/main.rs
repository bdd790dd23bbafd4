//! The public checkers on hand-made cases, planted faults and random scenes.

mod inner_envelopes;
mod solids;
mod surface;
mod volumes;
