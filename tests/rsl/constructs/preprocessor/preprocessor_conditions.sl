// #if chains, defined, arithmetic, nested, elif, undef
#define VERSION 3
#define QUALITY (VERSION * 2 - 1)
#undef NOTHING
#if defined(VERSION) && VERSION >= 3 && !defined NOTHING
#  define A 0.25
#  if QUALITY == 5 || 0
#    define B 0.5
#  else
#    define B broken(
#  endif
#elif VERSION == 2
this is never read '
#else
#error not here
#endif
#ifndef C_VALUE
#define C_VALUE 0.125
#endif C_VALUE
#ifdef BMRT
surface slim() { Ci = BMRT }
#else
surface preprocessor_conditions() { Ci = A + B + C_VALUE; }
#endif /* BMRT */
