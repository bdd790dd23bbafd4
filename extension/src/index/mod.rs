//! Index support for `box3d`: GiST, SP-GiST and BRIN, a file each, over one set of questions.

mod brin;
mod gist;
mod hilbert_order;
mod query;
mod spgist;
mod spgist_sys;
mod split;
