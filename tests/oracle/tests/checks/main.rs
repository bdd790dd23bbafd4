//! The public checkers on hand-made cases, planted faults and random scenes.

mod columns;
mod inner_envelopes;
mod prisms;
mod shapes;
mod solids;
mod surface;
mod volumes;
