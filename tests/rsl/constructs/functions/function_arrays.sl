// arrays as arguments, of open and of fixed length, and output
float total(float a[]; float n) {
    float i, sum = 0;
    for (i = 0; i < n; i += 1) sum += a[i];
    return sum;
}
void fill(output color ramp[3]; color base) {
    ramp[0] = base; ramp[1] = base * 0.5; ramp[2] = 1 - base;
}
surface function_arrays() {
    float w[5] = {1, 2, 3, 4, 5};
    color ramp[3];
    fill(ramp, Cs);
    Ci = (ramp[0] + ramp[1] + ramp[2]) * total(w, 5) * 0.05;
}
