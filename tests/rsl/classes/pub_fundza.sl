class fundza_rim(float Kd = 1, Ks = 0.5, roughness = 0.1,
          rimwidth = 0.2;
          color rimcolor = 1;
          string texname = "";)
{
varying normal n; varying normal nf; varying vector i;
constant float rw = 1 - rimwidth;

public void begin() {
    n = normalize(N);
    i = normalize(I);
    nf = faceforward(n, i);
    }
float getrim() {
    float dot = 1 - nf.-i;
    return smoothstep(rw, 1.0, dot);
    }
public void surface(output color Ci, Oi) {
    color diffusecolor = Kd * diffuse(nf);
    color texcolor = 1;
    if(texname != "")
        texcolor = texture(texname);
    Oi = Os;
    Ci = Oi * Cs * texcolor * diffusecolor + rimcolor * getrim();
    }
}
