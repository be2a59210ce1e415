#pragma annotation "grouping" "weave/a"
#pragma annotation "grouping" "weave/b"
class weave(
    float a = .3;
#pragma annotation a "label=Width; hint=slider"
    float b = .7;
#pragma annotation b "label=Height"
    output float result;
    string __category = "pattern"; ;)
{
    float int = 0;
    void compute(output float r;) {
        int = floor(s * 10) + floor(t * 10);;
        r = mod(int, 2) < .5 ? a : b;
    }
    void surface(output color Ci, Oi;) {
        compute(result);
        Ci = result; Oi = 1;
    }
}
