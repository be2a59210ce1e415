struct s { float a; }
surface x() { Ci = nothing; }
//! 1:1 error RSL_2 'struct'
