surface x() {
    break;
    float i;
    for (i = 0; i < 3; i += 1) {
        break 2;
    }
    while (i > 0) { i -= 1; continue 1; }
}
//! 2:5 error RSL_BREAK_OUTSIDE_LOOP 'break' outside a loop
//! 5:9 error RSL_BREAK_LEVELS 'break 2' but only 1 loop(s) around it
