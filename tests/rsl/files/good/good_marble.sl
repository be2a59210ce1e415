surface
marble( float Kd=.5, Ka=.1;
        color veincolor=0)
{
     float khi ;
     point fnormal ;
     color surfcolor ;
     point freq = 4 * P;
     float turbulence = 0;
     float amplitude = 1, octave;

    fnormal = faceforward( normalize(N), I ) ;
     for(octave = 0; octave < 6; octave = octave + 1 ) {
          turbulence = turbulence +
               amplitude * abs(.5 - noise(freq));
          amplitude = amplitude * .5;
          freq = freq * 2;
     }

    turbulence = 0.5 + 0.5 * sin(6*(xcomp(P)+turbulence)) ;
    turbulence = turbulence * turbulence * turbulence;
    khi = clamp((turbulence-0.5)*4, 0, 1);
    surfcolor = (1-khi)*Cs + khi*veincolor;
    Ci = surfcolor*(Ka*ambient() + Kd*diffuse(N));
}
