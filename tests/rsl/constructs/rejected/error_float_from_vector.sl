// float = vector
surface error_float_from_vector() { float a = N; Ci = a; }
