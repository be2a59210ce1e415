displacement bumpy(float amt = 2;) { P += amt * s * normalize(N); N = calculatenormal(P); }
