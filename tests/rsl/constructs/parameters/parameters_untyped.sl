// a parameter whose type is left out
surface parameters_untyped(Kd = 0.5; color c = 1) { Ci = c * Kd; }
