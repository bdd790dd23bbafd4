//! Index support, a file each: GiST, SP-GiST and BRIN for `box3d`, over one set of questions, and
//! GIN for `feature_set`.

mod brin;
mod gin;
mod gist;
mod hilbert_order;
mod query;
mod spgist;
mod spgist_sys;
mod split;
