/* tests/runtime/ri/header.c: ri.h in C89, C99 and C++, without warnings. */
#include "ri.h"

int ri_header_is_read(void);
int ri_header_is_read(void)
{
    RtFloat width = RiBoxFilter(0, 0, 1, 1);
    return RI_NULL == 0 && RI_INFINITY > width;
}
