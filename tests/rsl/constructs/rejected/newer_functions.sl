// built-ins of RSL 2.0
surface newer_functions() { float a[3]; push(a, 2); Ci = undefined; }
