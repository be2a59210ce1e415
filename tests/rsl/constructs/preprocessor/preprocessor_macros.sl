// function-like macros, continued lines, # and ##, empty and nested arguments
#define sqr(x) ((x) * (x))
#define LERP(a, b, t) \
    ((1 - (t)) * (a) + \
     (t) * (b))
#define NAME(a, b) a##_##b
#define QUOTE(x) #x
#define EXPAND(x) QUOTE(x)
#define EMPTY
#define CALL(f, x) f(x)
#define DECLARE_KD float Kd = 0.5; color NAME(tint, one) = color(1, 0.5, 0.25);
#define LIST(...) color(__VA_ARGS__)
#define SELF SELF
surface preprocessor_macros(DECLARE_KD float plain = 2 EMPTY) {
    float SELF = 2;
    string text = QUOTE(a "b" \n), version = EXPAND(sqr);
    Ci = tint_one * Kd * sqr(sqr(s) + 1) * LERP(0.1, sqr(t), CALL(abs, s - 0.5)) + LIST(s, t, 0) * plain * SELF;
    if (version == "sqr") Ci += 0.1;
}
