surface x(int a = 1; float b = ; color c = (1, 2; matrix = 3; string d = 4,
          point e[2] = {0, +}; float f = 1)
{
    Ci = a * f * nosuch;
}
//! 1:11 error RSL_UNKNOWN_TYPE write 'float'
//! 1:32 error RSL_SYNTAX expected an expression
//! 1:49 error RSL_SYNTAX expected ')'
//! 1:58 error RSL_SYNTAX variable name
//! 2:29 error RSL_SYNTAX expected an expression
//! 1:74 error RSL_TYPE_MISMATCH needs string
//! 4:18 error RSL_UNKNOWN_VARIABLE nosuch
