surface x() {
    v0 = 1;
    v1 = 1;
    v2 = 1;
    v3 = 1;
    v4 = 1;
    v5 = 1;
    v6 = 1;
    v7 = 1;
    v8 = 1;
    v9 = 1;
    v10 = 1;
    v11 = 1;
    v12 = 1;
    v13 = 1;
    v14 = 1;
    v15 = 1;
    v16 = 1;
    v17 = 1;
    v18 = 1;
    v19 = 1;
    v20 = 1;
    v21 = 1;
    v22 = 1;
    v23 = 1;
    v24 = 1;
}
//! 2:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v0'
//! 3:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v1'
//! 4:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v2'
//! 5:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v3'
//! 6:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v4'
//! 7:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v5'
//! 8:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v6'
//! 9:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v7'
//! 10:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v8'
//! 11:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v9'
//! 12:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v10'
//! 13:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v11'
//! 14:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v12'
//! 15:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v13'
//! 16:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v14'
//! 17:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v15'
//! 18:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v16'
//! 19:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v17'
//! 20:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v18'
//! 21:5 error RSL_UNKNOWN_VARIABLE unknown variable 'v19'
//! 22:5 error RSL_TOO_MANY_ERRORS more than 20 errors; the rest is not shown
