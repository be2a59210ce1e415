#define OCTAVES 5
#define fbm(p, sum) { float k_; point q_ = p; float a_ = 1; sum = 0; for (k_ = 0; k_ < OCTAVES; k_ += 1) { sum += a_ * (float noise(q_) - .5); a_ *= .5; q_ *= 2; } }
class flow_noise(float freq = 2; color c1 = color(.1, .2, .4), c2 = color(.8, .9, 1);)
{
    public varying float result;
    public void begin()
    {
        float f, g;
        point PP = transform("object", P) * freq;
        fbm(PP, f);
        fbm(PP + vector(f, f, f), g);
        result = g + .5;
    };
    public void surface(output color Ci, Oi)
    {
        Oi = Os;
        Ci = Os * spline(clamp(result, 0, 1), c1, c1, c2, c1, c2, c2);
    };
};
