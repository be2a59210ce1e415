// words of RSL 2.0 and C as plain names
#define int float
surface names_newer(float public = 1; float null = 2) {
    int i = 1;
    float class = s, shader = t, struct = 0.5, this = 1, new = 2, integral = 3, do = 1, goto = 2, end = 4;
    Ci = class * shader * struct * this * new * integral * i * public * null * do * goto * end * 0.1;
}
