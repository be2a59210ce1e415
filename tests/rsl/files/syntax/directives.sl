#defin A 1
#include "no_such_file.h"
#if 1 / 0
#endif
#else
#define f(a, b) a + b
#define g(
#error stop here
surface x() {
    Ci = f(1);
    Ci = 1 +;
}
#ifdef Q
