// tiles by floor and mod, antialiased mortar
#define BMWIDTH (brickwidth+mortarthickness)
#define BMHEIGHT (brickheight+mortarthickness)
#define MWF (mortarthickness*0.5/BMWIDTH)
#define MHF (mortarthickness*0.5/BMHEIGHT)
surface style_1990s_brick(uniform float jagged = 0.006; uniform float brickwidth = .25, brickheight = .08,
      mortarthickness = .01; uniform float rowvary = .25; color Cbrick = color(.5,.15,.14), Cmortar = .5;) {
    color bcolor, Ct;
    float sbrick, tbrick, w, h, ss, tt;
    float swidth = max(abs(Du(s)*du) + abs(Dv(s)*dv), 1e-5), twidth = max (abs(Du(t)*du) + abs(Dv(t)*dv), 1e-5);
    tt = t + jagged * (noise(s/0.05, t/0.05)-.5);
    ss = s / BMWIDTH; tt /= BMHEIGHT;
    if (mod(tt*0.5,1) > 0.5) ss += 0.5;
    tbrick = floor(tt); ss += rowvary * (noise(tbrick+0.5) - 0.5);
    sbrick = floor(ss); ss -= sbrick; tt -= tbrick;
    w = smoothstep(MWF-swidth,MWF,ss) - smoothstep(1-MWF,1-MWF+swidth,ss);
    h = smoothstep(MHF-twidth,MHF,tt) - smoothstep(1-MHF,1-MHF+twidth,tt);
    bcolor = Cbrick * (0.8 + 0.4 * cellnoise(sbrick, tbrick));
    Ct = mix(Cmortar, bcolor, w*h);
    Ci = Ct; Oi = 1;
}
