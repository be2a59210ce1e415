// lines that end in CR LF, with continued macros
#define TWICE(x) \
    ((x) + \
     (x))
surface text_crlf(float Kd = 1;
                  color c = 1) {
    Ci = TWICE(Kd) * c; // comment
    /* more
       lines */
    Oi = 1;
}
