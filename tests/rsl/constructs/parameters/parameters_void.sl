// (void) as in C
float half_of_one(void) { return 0.5; }
surface parameters_void(void) { Ci = half_of_one() * Cs; }
