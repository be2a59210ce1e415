surface x() {
    string text = "";
    writeaov("h", s);
    readaov("h", text);
    Ci = 1;
}
//! 4:18 error RSL_OUTPUT_TYPE argument 2 of 'readaov'
