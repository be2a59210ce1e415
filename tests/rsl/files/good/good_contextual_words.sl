float light(float volume) { return volume; }
surface surface(float displacement = 1, imager = 2;) {
    float volume = light(displacement), solar = 1, gather = 2, illuminate = imager;
    Ci = volume + solar * gather - illuminate;
}
