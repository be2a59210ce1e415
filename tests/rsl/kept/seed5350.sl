// world 5350
surface fuzz() { color r[2] = {1, 1}; float k; for (k = 0; k < 3; k += 1) { P = exp(Ps); } r[float area(P, "world")] -= 1; Oi = r[0]; }
