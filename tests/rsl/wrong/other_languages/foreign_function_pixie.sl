surface x() { Ci = urandom(); }
//! 1:20 error RSL_FOREIGN_FUNCTION Pixie
