/PROG  CELL
/ATTR
COMMENT		= "P[1]{";
DEFAULT_GROUP	= 1,*,*,*,*;
/MN
   1:J P[1] 100% FINE    ;
   2:J P[2] 100% FINE    ;
   3:J P[3] 100% FINE    ;
   4:J P[4] 100% FINE    ;
   5:J P[5] 100% FINE    ;
   6:J P[6] 100% FINE    ;
   7:J P[7] 100% FINE    ;
   8:J P[8] 100% FINE    ;
   9:J P[9] 100% FINE    ;
  10:J P[10] 100% FINE    ;
  11:J P[11] 100% FINE    ;
  12:J P[12] 100% FINE    ;
  13:J P[13] 100% FINE    ;
  14:J P[14] 100% FINE    ;
  15:J P[15] 100% FINE    ;
  16:J P[16] 100% FINE    ;
  17:L PR[1] 100mm/sec FINE    ;
/POS
P[1]{
   GP1:
	UF : 0, UT : 1,		CONFIG : 'N U T, 0, 0, 0',
	X =    77.282  mm,	Y =   154.172  mm,	Z =  -377.256  mm,
	W = -136.5232 deg,	P =  -32.9732 deg,	R =   91.8244 deg
};
P[2:"home é"]{
   GP1:
	UF : 0, UT : 1,	
	J1=   106.005 deg,	J2=    65.355 deg,	J3=   -25.772 deg,
	J4=   -63.030 deg,	J5=   -53.178 deg,	J6=   -18.674 deg
};
P[3]{
   GP1:
	UF : 0, UT : 1,		CONFIG : 'N U T, 0, 0, 0',
	X =   408.923  mm,	Y =   -79.439  mm,	Z =  -179.253  mm,
	W =   47.9314 deg,	P =   75.2773 deg,	R =  -26.5595 deg
};
P[4]{
   GP1:
	UF : 0, UT : 1,	
	J1=   104.392 deg,	J2=   -26.522 deg,	J3=    66.175 deg,
	J4=    28.797 deg,	J5=    25.214 deg,	J6=    59.993 deg
};
P[5]{
   GP1:
	UF : 0, UT : 1,		CONFIG : 'N U T, 0, 0, 0',
	X =   162.222  mm,	Y =    61.710  mm,	Z =   296.163  mm,
	W =  -46.7269 deg,	P =  -26.4136 deg,	R = -141.3534 deg
};
P[6]{
   GP1:
	UF : 0, UT : 1,	
	J1=   126.739 deg,	J2=    31.146 deg,	J3=    -7.455 deg,
	J4=   -39.588 deg,	J5=   -21.371 deg,	J6=  -157.061 deg
};
P[7]{
   GP1:
	UF : 0, UT : 1,		CONFIG : 'F U T, 0, 0, 0',
	X =  -124.144  mm,	Y =   295.708  mm,	Z =   382.189  mm,
	W = -107.2325 deg,	P =   -9.2030 deg,	R =  -12.5728 deg
};
P[8]{
   GP1:
	UF : 0, UT : 1,	
	J1=    80.113 deg,	J2=    17.744 deg,	J3=   -33.203 deg,
	J4=   121.020 deg,	J5=   -21.205 deg,	J6=  -146.637 deg
};
P[9]{
   GP1:
	UF : 0, UT : 1,		CONFIG : 'F U T, 0, 0, 0',
	X =   172.332  mm,	Y =  -186.729  mm,	Z =   -20.717  mm,
	W = -109.5426 deg,	P =    8.9247 deg,	R =  151.4452 deg
};
P[10]{
   GP1:
	UF : 0, UT : 1,	
	J1=    42.775 deg,	J2=   103.743 deg,	J3=   -50.117 deg,
	J4=   -32.552 deg,	J5=   -71.301 deg,	J6=   -97.611 deg
};
P[11]{
   GP1:
	UF : 0, UT : 1,		CONFIG : 'F U T, 0, 0, 0',
	X =   214.023  mm,	Y =  -306.619  mm,	Z =  -420.880  mm,
	W =  177.3563 deg,	P =   23.1009 deg,	R = -133.6336 deg
};
P[12]{
   GP1:
	UF : 0, UT : 1,	
	J1=   -29.199 deg,	J2=    58.087 deg,	J3=    36.740 deg,
	J4=    73.597 deg,	J5=   -92.831 deg,	J6=   102.692 deg
};
P[13]{
   GP1:
	UF : 0, UT : 1,		CONFIG : 'N U T, 0, 0, 0',
	X =  -106.543  mm,	Y =    84.184  mm,	Z =    21.200  mm,
	W =  -92.5859 deg,	P =  -10.7311 deg,	R = -176.7917 deg
};
P[14]{
   GP1:
	UF : 0, UT : 1,	
	J1=   -82.972 deg,	J2=   -68.749 deg,	J3=    -7.930 deg,
	J4=  -147.525 deg,	J5=    21.693 deg,	J6=    60.477 deg
};
P[15]{
   GP1:
	UF : 0, UT : 1,		CONFIG : 'F U T, 0, 0, 0',
	X =  -136.133  mm,	Y =   -71.959  mm,	Z =    67.250  mm,
	W =  172.0843 deg,	P =   -9.0008 deg,	R =  -18.5213 deg
};
P[16]{
   GP1:
	UF : 0, UT : 1,	
	J1=    98.052 deg,	J2=   -81.590 deg,	J3=    28.035 deg,
	J4=   122.439 deg,	J5=   -72.652 deg,	J6=    47.175 deg
};
/END
