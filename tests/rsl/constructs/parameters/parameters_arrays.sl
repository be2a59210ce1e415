// arrays as shader parameters with and without all values
surface parameters_arrays(float weight[4] = {0.1, 0.2, 0.3, 0.4}; color ramp[3] = {color(1, 0, 0), (0, 1, 0), 0.5};
                          string names[2] = {"one", "two"}; uniform float open[] = {1, 2, 3}) {
    uniform float i;
    float sum = 0;
    for (i = 0; i < 4; i += 1) sum += weight[i];
    Ci = ramp[0] * sum + ramp[2] * open[1];
    if (names[1] == "two") Ci += 0.25;
}
