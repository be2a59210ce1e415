// comparisons as floats
surface expression_bool() {
    float b = s > 0.5;
    float both = (s > 0.25) * (t > 0.25);
    float either = s > 0.75 || t > 0.75;
    float neither = !either;
    color mask = (s < t) * Cs;
    float count = (s > 0.1) + (s > 0.2) + (s > 0.3);
    Ci = mask + b * 0.1 + both * 0.2 + either * 0.3 + neither * 0.4 + count * 0.01 + (b == both);
    Ci *= (Cs == Os) ? 1 : 0.5;
}
