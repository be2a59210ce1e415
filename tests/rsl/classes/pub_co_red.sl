class red() { public void opacity(output color Oi) { Oi = .5; } public void surface(output color Ci, Oi) { Ci = color(1,0,0); Oi = .5; } }
