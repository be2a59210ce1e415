float two(float list[]) { return list[1] + list[-1]; }
surface x(float n = 3, open[] = {1, 2}, given[2] = {1, 2};) {
    float b[2], grows[] = {1}, one[1], i = 5, j = 1, k = 0;
    color c = (1, 2, 3);
    matrix m = 1;
    b[2] = 1;
    b[-1] = 3;
    b[i] = 2;
    b[j] = 2;
    float x = b[7] + b[1 + 1] + b[1.9] + b[-0.5] + one[1];
    k += n;
    b[k] = 1;
    b[n] = 2;
    push(grows, 1);
    x += grows[9] + grows[-2] + open[4] + open[-1] + given[2] + given[1];
    c[3] = 1;
    x += c[2] + comp(c, 3) + comp(c, 0) + comp(m, 3, 4) + comp(m, 4, 3) + comp(m, 0, 3);
    setcomp(c, -1, 2);
    Ci = x + two(b) + c + b[0];
}
//! 1:49 warning RSL_INDEX_RANGE index -1 is outside of array 'list', whose elements are 0 and above
//! 6:7 warning RSL_INDEX_RANGE index 2 is outside of array 'b', whose elements are 0 to 1
//! 7:7 warning RSL_INDEX_RANGE index -1
//! 8:7 warning RSL_INDEX_RANGE index 5
//! 10:17 warning RSL_INDEX_RANGE index 7
//! 10:24 warning RSL_INDEX_RANGE index 2
//! 10:44 warning RSL_INDEX_RANGE index -0.5
//! 10:56 warning RSL_INDEX_RANGE index 1 is outside of array 'one', whose elements are 0
//! 15:27 warning RSL_INDEX_RANGE index -2 is outside of array 'grows', whose elements are 0 and above
//! 15:48 warning RSL_INDEX_RANGE index -1 is outside of array 'open'
//! 15:60 warning RSL_INDEX_RANGE index 2 is outside of array 'given'
//! 16:7 warning RSL_INDEX_RANGE index 3 is outside of a color, whose elements are 0 to 2
//! 17:25 warning RSL_INDEX_RANGE index 3
//! 17:54 warning RSL_INDEX_RANGE index 4 is outside of a matrix, whose elements are 0 to 3
//! 17:67 warning RSL_INDEX_RANGE index 4
//! 18:16 warning RSL_INDEX_RANGE index -1
