// uniform = varying
surface error_uniform_from_varying() { uniform float a = s; Ci = a; }
