// unknown function
surface error_unknown_function() { Ci = dot(N, I); }
