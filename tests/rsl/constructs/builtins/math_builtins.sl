// trigonometry, powers, logarithms, rounding
surface math_builtins() {
    float a = radians(30) + degrees(0.1) * 0.01 + sin(s) + cos(t) + tan(s * 0.5) + asin(s * 0.5) + acos(t * 0.5);
    float b = atan(s) + atan(s, t + 1) + exp(-s) + log(s + 1) + log(8, 2) + sqrt(s) + inversesqrt(s + 1);
    float c = pow(s, 2) + mod(s * 5, 1) + abs(-s) + sign(s - 0.5) + floor(s * 3) + ceil(t * 3) + round(s * 4);
    float d = min(s, t, 0.3) + max(s, t) + clamp(s * 2, 0, 1) + mix(s, t, 0.3) + step(0.5, s) + smoothstep(0, 1, t);
    Ci = (a + b + c + d) * 0.05;
}
