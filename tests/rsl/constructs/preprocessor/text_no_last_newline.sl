// a file whose last line has no newline
surface text_no_last_newline() { Ci = 0.5; }
#define LAST 1