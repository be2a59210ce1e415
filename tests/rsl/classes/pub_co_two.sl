class two() { public float bias = 2; public void shade(output color c; output float f) { c = color(0,s,0); f = 0.5; } }
