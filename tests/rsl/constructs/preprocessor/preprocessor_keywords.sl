// #define of type and control words; macros that look like statements
#define vector point
#define normal point
#define forever while (1)
#define IF(x) if (x) {
#define ENDIF }
#define BEGIN {
#define END }
surface preprocessor_keywords()
BEGIN
    vector v = I;
    normal n = normalize(N);
    float i = 0;
    forever { i += 1; if (i > 3) break; }
    IF(s > 0.5) Ci = Cs; ENDIF
    Ci += (v . n) * 0.1 + i * 0.1;
END
