//! Solid columns of chosen, random and real solids, against winding numbers next to every corner and
//! edge, exact cell counts and the best staircases.

mod chosen;
mod random;
mod real;
mod solids;
