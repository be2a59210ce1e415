// '^' binds looser than '*', '.' tighter; unary signs
surface expression_precedence(float Kd = 0.5) {
    vector V = normalize(-I);
    float lambert = Kd * I.N * I.N;
    vector b = 2 * V ^ N * 0.5;
    float d = -I.N;
    float e = - - s + +t;
    float f = 1 - 2 - 3 / 4 / 5;
    float g = s < t == t > s;
    float h = s--t * 2 --1;
    Ci = lambert * 0.01 + color(b) * 0.1 + d * 0.1 + e + f * 0.1 + g * !s + h;
}
