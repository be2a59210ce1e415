class x() {
    public void surface(output color Ci, Oi) { solar() { Oi = 1; } Ci = 1; }
}
//! 2:48 error RSL_STATEMENT_NOT_LEGAL solar
