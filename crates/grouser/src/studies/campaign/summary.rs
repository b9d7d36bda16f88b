//! What many runs say of one quantity.
