// a long statement over many lines; odd spacing and case
surface
style_filament
(
	float	Kd = 1 ,
		Ka = 0 ;
	color	LineColor =
			color ( 0.9 , 0.1 , 0.1 ) ;
)
{
	float	 X = mod ( s * 8 , 1 ) , Y = mod ( t * 8 , 1 ) ;
	float x = ( X - 0.5 ) , y
		= ( Y - 0.5 ) ;
	if ( ( x * x + y * y ) < 0.1 )
		{ Ci = LineColor ; }
	else
	if ( X > 0.9 )
		Ci = LineColor * 0.5
		   + Ka ;
	else
		Ci = Cs * Kd
	;
	Oi = 1 ;
}
