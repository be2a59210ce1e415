surface x(float a = 1);
{
    Ci = b;
}
//! 1:23 error RSL_SYNTAX leave the ';' out
//! 3:10 error RSL_UNKNOWN_VARIABLE 'b'
