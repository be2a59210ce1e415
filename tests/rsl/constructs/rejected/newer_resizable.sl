// resizable arrays
surface newer_resizable() { float a[]; Ci = 1; }
