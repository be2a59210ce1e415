// comments of C and C++, in expressions and directives
/* one /* not nested */
#define HALF 0.5 // of one
#define TWO_LINES 1 + /* over
   two lines */ 2
surface comments(/* none */) { // ***
    float a /* named */ = HALF; /**/
    Ci = a * (TWO_LINES) /* * 3 */; // + 1
    //* odd */ Ci = 7;
}
