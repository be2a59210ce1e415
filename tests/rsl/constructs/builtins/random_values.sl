// random() of every type, also to uniform
surface random_values() {
    float a = random();
    color c = random();
    point p = point random();
    uniform float once = random();
    Ci = (c + color p + a + once) * 0;
}
