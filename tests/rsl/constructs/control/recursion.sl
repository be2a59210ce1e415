// a function that calls itself
float factorial(float n) {
    if (n <= 1) return 1;
    return n * factorial(n - 1);
}
surface recursion() { Ci = factorial(4) * s * 0.01; }
