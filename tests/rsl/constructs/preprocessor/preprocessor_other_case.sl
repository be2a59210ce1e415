// headers named in another letter case and with folders before them
#include "Parts.H"
#include <include/NOISES.h>
#include "..\shaders\Patterns.h"
#if 0x10 > 15u
surface preprocessor_other_case() { Ci = snoise(P) * pulse(0.2, 0.4, s) * 0x10; }
#endif
