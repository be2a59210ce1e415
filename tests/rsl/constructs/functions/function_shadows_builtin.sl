// user functions and macros hide built-ins
float smoothstep(float a, b, x) { return clamp((x - a) / (b - a), 0, 1); }
float mix(float a, b, t) { return a + (b - a) * t * t; }
#define step(a, b) ((b) < (a) ? 0 : 0.75)
surface function_shadows_builtin() {
    Ci = smoothstep(0, 1, s) + mix(0.1, 0.9, t) + step(0.5, s) + mix(Cs, Os, 0.5);
}
