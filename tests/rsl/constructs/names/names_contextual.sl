// light, volume, surface, imager, gather, solar as names of variables and functions
float volume(float light) { return light * light; }
surface names_contextual(float light = 0.5, imager = 0.25; color surface = 1) {
    float displacement = s, transformation = t, gather = 0.5, solar = 2, illuminate = 1, illuminance = 3;
    light += 0.1;
    volume(light);
    gather *= 2;
    Ci = surface * volume(light + displacement) * transformation + imager * gather * solar * 0.1;
    Ci += illuminate * illuminance * 0.01;
}
