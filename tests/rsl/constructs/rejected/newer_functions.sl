// built-ins of RSL 2.0 for co-shaders
surface newer_functions() { float a = getshader("base"); Ci = undefined; }
