#define PASTE(a, b) a ## b
#define TEXT(x) #x
#define MAX3(a, b, c) max(a, \
                          max(b, c))
#define EMPTY
#define SELF SELF
#if defined(KINORA) && (1 + 2 * 3 == 7 ? 1 : 0) && !defined NOTHING
#define OK 1
#elif 1
#error never
#else
#error never
#endif
#ifndef OK
# error never
#endif
#pragma annotation "grouping" "a/b"
#line 1
#if 0
"unbalanced ' text in a skipped group
#endif
surface x(float SELF = 1;) {
    float PASTE(al, pha) = MAX3(1, 2, 3) EMPTY;
    string text = TEXT(a "b" + c);
    printf("%s %f", __FILE__, __LINE__);
    Ci = alpha + SELF; // last line without its newline
}