#include "noises.h" float x = 3;
#include <patterns.h> /* a comment */
#include "normals.h";
surface x() { Ci = 1; }
//! 1:21 warning RSL_TEXT_BEHIND_INCLUDE 'float' and what follows it behind #include is left out
