class kid(float gain = 5) { public float value(uniform float i) { return gain + i; } }
