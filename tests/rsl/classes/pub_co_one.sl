class one(float bias = 1;) { public void shade(output color c; output float f) { c = color(1,0,0); f = 0.25; } }
