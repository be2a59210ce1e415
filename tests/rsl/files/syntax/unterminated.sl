surface x() {
    string a = "abc;
    Ci = 1;
}
/* never closed
