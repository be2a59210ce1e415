// Public methods with and without arguments, overloads, this->.
class public_methods(float Kd = 1; color tint = color(0.3, 0.6, 0.9);)
{
    public float pattern = 0;
    public varying color value = 0;
    public color getColor() { return value; }
    public color getColor(float gain) { return gain * value; }
    public void getColor(float gain; output color result; output float alpha) { result = gain * value; alpha = pattern; }
    public void setPattern(varying float p) { pattern = clamp(p, 0, 1); }
    public void begin()
    {
        setPattern(noise(10 * s, 10 * t));
        value = tint * pattern;
    }
    public void surface(output color Ci, Oi)
    {
        color c = 0; float a = 0;
        this->getColor(0.5, c, a);
        Oi = Os * mix(1, a, 0.5);
        Ci = Oi * Kd * (c + 0.25 * getColor() + 0.25 * this->getColor(2)) * diffuse(faceforward(normalize(N), I));
    }
}
