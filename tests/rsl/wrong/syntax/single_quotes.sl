surface x(string a = 'wood') { Ci = 1; }
//! 1:22 error RSL_BAD_CHARACTER unexpected '''
