surface x() {
    if (s > 0.5) Ci = 1;
    elseif (s > 0.2) Ci = 2;
    elif (s > 0.1) { Ci = 3; }
    else Ci = 0;
}
//! 3:5 error RSL_NOT_RSL write 'else if'
//! 4:5 error RSL_NOT_RSL write 'else if'
