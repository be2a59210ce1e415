// writeaov and readaov; stof, strlen, sprintf; constant storage
void keep(color c) { writeaov("kept", c); }
surface named_outputs(constant float gain = 2; output varying float declared = 0;) {
    constant float half = 0.5;
    float known, unknown, value = 3;
    color back = 0;
    keep(Cs * s);
    writeaov("declared", s * t);
    writeaov("facing", normalize(N) . normalize(-I) > 0.5);
    known = readaov("kept", back);
    if (readaov("nothing", value)) value = 100;
    unknown = readaov("declared", value);
    string text = sprintf("%d", floor(s * 100));
    Ci = back * half + known + value + unknown + stof(text) * gain + strlen(text) + stof("-2.5e1x") + stof("") + stof("  +3");
    Oi = 1;
}
