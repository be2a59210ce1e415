// lists of lights, of RSL 2.0
surface newer_functions() { shader a[] = getlights("diffuse"); Ci = undefined; }
