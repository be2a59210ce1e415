surface mat(float Kd = 1; color tint = color(0,0,1);) { normal Nf = faceforward(normalize(N), I); Oi = Os; Ci = Oi * tint * (Kd * diffuse(Nf) + 1); }
