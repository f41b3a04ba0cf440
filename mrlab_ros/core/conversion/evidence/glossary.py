"""Words of names, headings, labels and texts, by class; a word may have several classes.

Small letters; accents are stripped and umlauts spelled out (`names.cut` does the same). A name is
understood where these words cover all of it; every other word is unread and is asked about. So a
word that is missing here costs a warning, never a wrong motion.
"""

from __future__ import annotations

from enum import Enum


class Class(Enum):
    """What a word does in a name."""

    SYMBOL = "symbol"  # of joint positions: q, theta
    JOINT = "joint"
    ANGLE = "angle"
    CONFIGURATION = "configuration"  # joint positions by itself
    PLACE = "place"  # of joints or of the tool
    MOTION = "motion"  # of joints or of the tool
    ROLE = "role"  # desired, measured: changes nothing
    KEPT = "kept"  # how the numbers are kept: log, filtered: changes nothing
    ABOUT = "about"  # a struct or field that only holds the rest
    ARM = "arm"
    SIDE = "side"
    UNIT_KEY = "unit_key"
    UNIT_FLAG = "unit_flag"  # is_degrees, use_radians
    CLOCK = "clock"
    PERIOD = "period"
    RATE = "rate"
    SAMPLING = "sampling"
    DURATION = "duration"
    ORDER = "order"
    NAMES = "names"
    GEAR = "gear"
    FACTOR = "factor"  # what numbers may have to be multiplied by
    MOTOR = "motor"
    GRIPPER = "gripper"
    TABLE = "table"  # what a number beside the matrix may be: mass, seed, count
    ADMIN = "admin"  # a text of this name is about the file, not about its numbers
    OTHER = "other"  # another quantity, by QUANTITIES


CLASSES = {
    Class.SYMBOL: "q th theta thetas thl thr phi phis qs qj qc qt qds qmat qik qi qf q0 qn",
    Class.JOINT: """
        joint joints jnt jnts jt gelenk gelenke gelenks achse achsen achs axis axes
        articulation articulations articulaire articulaires articulacion articulaciones articular
        articulares eje ejes giunto giunti asse assi junta juntas eixo eixos articulacao
        gewricht gewrichten assen przegub przeguby przegubow osie staw stawy stawow
        eklem eksen guanjie zhou kansetsu jiku klouby kloub sustav
        сустав сустава суставов шарнир ось оси 关节 轴 関節 軸 관절 축 articolazione articolazioni
        axe axes liaison liaisons""",
    Class.ANGLE: """
        angle angles ang winkel winkels angulo angulos angolo angoli angulaire angulaires
        angular angulares angolare angolari hoek hoeken kat katy katow aci acilar acisi jiaodu jiao
        kakudo guanjiao uhel uhly ugol ugly угол углы угла 角 角度 각도 rotaties anguli""",
    Class.CONFIGURATION: """
        config configs configuration configurations konfiguration konfigurationen jpos jangles
        configuracion configuraciones configurazione configurazioni configuracao configuracoes
        gelenkstellung gelenkstellungen stellung stellungen pointrecord angleexport""",
    Class.PLACE: """
        pos position positions posn posicion posiciones posizione posizioni posicao posicoes lage
        lagen positie posities pozycja pozycje konum pozisyon weizhi ichi poloha polohy
        координата координаты положение положения 位置 위치 positionen coordinate coordinates
        koordinaten coords coordonnee coordonnees coordenadas coordinata value values
        waarden waarde valeur valeurs valor valores valore valori
        state states zustand estado estados etat etats stato point points punkt punkte
        pt pts pose punto puntos punti ponto pontos stuetzpunkte observation observations""",
    Class.MOTION: """
        traj trajs trajectory trajectories trj path paths bahn bahnen pfad pfade bahndaten motion
        motions movement movements move moves bewegung bewegungen bewegungs trajektorie
        trajektorien waypoint waypoints wp wps wegpunkte wegpunkt via keyframe keyframes route plan
        plans trayectoria trayectorias camino movimiento movimientos recorrido trajectoire
        trajectoires chemin mouvement mouvements parcours traiettoria traiettorie percorso
        movimento movimenti movimentos trajetoria trajetorias caminho percurso traject trajecten
        beweging bewegingen sciezka trajektoria ruch yorunge hareket guiji lujing yundong kidou
        trajektorie pohyb draha drahy траектория движение путь 轨迹 軌跡 軌道 运动 路径 궤적
        verlauf verlaeufe course profil profile""",
    Class.ROLE: """
        actual act measured meas ist target desired des ref reference soll cmd command commanded
        commands current present set setpoint setpoints demand goal goals feedback fb real mes
        mesure mesuree mesurees mesures mis med consigne consignes reel reelle reelles desire
        desires desiree desirees souhaite souhaitee medido medida medidos medidas deseado deseada
        deseados deseadas consigna referencia actuales reales misurato misurata misurati misurate
        desiderato desiderata desiderati desiderate riferimento attuale attuali reali desejado
        desejada desejados desejadas atual atuais gemeten gewenst gewenste zmierzone zadane zadana
        zadany referans olculen istenen shiji qiwang cankao mokuhyou zadana mereni sollwert
        sollwerte istwert istwerte gewuenscht gewuenschte gemessen gemessene vorgabe start home
        begin final end ende nominal planned plan geplant gepland planificado pianificato planifie
        track tracked simulated sim simuliert simule simulado
        simulata sensor encoder enc init initial следующий заданный измеренный заданные 期望 实际
        目标 測定 目標 expected in input output out new neu nouveau nueva best opt optimal nom sp
        nieuw nieuwe werkelijk werkelijke reais finale finali nuovo nuova novo novas
        action actions""",
    Class.KEPT: """
        log logs logged data daten dat donnees datos dati dados dane veri shuju deta dados record
        records recorded recording rec aufnahme aufzeichnung aufgezeichnet history hist filtered
        filt filter smoothed smooth geglaettet gefiltert lisse filtre filtrado filtrato
        filtrados filtrada filtradas filtrati filtrata filtrate gefilterd filtree filtres filtrees
        suavizado suavizada suavizados lisses interpolated interp interpoliert raw roh unwrapped
        sampled samples sample resampled mat
        matrix matrices matriz matrice matriks list lista liste listen vec vector vectors vektor
        vektoren array arr table tabelle tabla tableau tab seq sequence sequenz sequence secuencia
        result results res resultat resultate ergebnis ergebnisse resultats resultados risultati
        sol solution solutions loesung all full total whole combined complete alle alles todo
        todos tous ds export exported saved save copy kopie file run lauf test trial versuch exp
        experiment messung messungen messwerte enregistrement enregistrees registro registrado
        registrata dataset signal signals ts timeseries col cols column columns row rows spalte
        frame frames sample part segment seg demo example beispiel ejemplo exemple
        esempio exemplo my mein mon mi his version ver v1 v2 tmp final the of der die das des de
        du del della di la le les los las el et und and per von pro to fuer for robot robots
        roboter robota arm arms""",
    Class.ABOUT: """
        meta metadata info infos param params parameter parameters settings setup config cfg
        header options out simout yout ans struct field fields obj object content inhalt extra
        description desc beschreibung descripcion descrizione descricao comment comments kommentar
        remark note notes notiz """,
    Class.ARM: "arm arms robot robots roboter roboterarm bras brazo braccio braco ramie",
    Class.SIDE: """
        left right links rechts gauche droite izquierdo izquierda derecho derecha sinistro sinistra
        destro destra esquerdo esquerda direito direita l r""",
    Class.UNIT_KEY: """
        unit units einheit einheiten unite unites unidad unidades unita unidade unidades eenheid
        jednostka jednostki birim danwei tani jednotka единица 单位 単位 measure uom
        misura medida mesure messeinheit miary""",
    Class.UNIT_FLAG: "is use uses used in are as flag",
    Class.CLOCK: """
        t time times tout tvec timevector zeit zeiten tiempo tiempos temps tempo tempos tempi tijd
        tijden czas zaman sure shijian jikan cas время 时间 時間 시간 timestamp timestamps stamp
        stamps zeitstempel zeitpunkt zeitpunkte elapsed clock uhr datenum datetime tspan tick ticks
        ttraj tlog tsim tt tq ts instant instants instantes istanti
        horodatage tijdstempel tijdstempels temporale temporal temporel""",
    Class.PERIOD: """
        dt ts te ta tm tc deltat tstep timestep dtime deltatime takt taktzeit takzeit zeitschritt
        period periode periodo periodes stap step schritt interval intervall intervalle intervalo
        intervallo cycle cycletime zyklus zykluszeit ciclo pas paso passo delta schrittweite ech
        tsample tcycle tabtast tastzeit zhouqi shuki 周期 okres krok""",
    Class.RATE: """
        fs fe fa fm fc freq frec freqs frequency frequenz frequence frequencia frecuencia frequenza
        frequentie rate rates hz khz fps framerate samplerate takte pinlv pinlu shuuhasuu
        czestotliwosc frekans frekvence 频率 周波数 cadence taux
        tasa tasso taxa fsample fsampling f sps""",
    Class.SAMPLING: """
        sample samples sampling samp abtast abtastung abtastungen abtastzeit abtastrate
        abtastfrequenz abtastintervall abtastperiode echantillonnage echantillon echant ech camp
        muestr amostr         bemonstering bemonsterings ctrl logging muestreo muestra
        campionamento campione amostragem amostra control controller controle controllo loop
        update publish record recording frame frames per second capture acquisition servo
        regel regler ros probkowania ornekleme caiyang bild bilder bildern cycle sequence
        echantillons muestras muestra campioni amostras images imagen imagenes immagini imagens
        messwert messwerte messpunkt messpunkte werte mesure mesures medicion mediciones misura
        misure medida medidas probe proben shuju 采样 点 个点 帧 次 数据点""",
    Class.DURATION: """
        duration dauer duree totale totali gesamt zong shichang 时长 duracion durata
        duracao tf tfinal tend ttotal ttot tmax totaltime
        movetime gesamtzeit endzeit simtime stoptime tstop tges motiontime total end final length
        sure czastrwania""",
    Class.ORDER: """
        order ordering reihenfolge ordre orden ordine ordem volgorde kolejnosc sira permutation
        perm index indices idx sequence mapping map shunxu junjo 顺序 次序 順序""",
    Class.NAMES: """
        name names namen nom noms nombre nombres nome nomi nomes label labels heading headings
        header headers titles columns columnas colonnes beschriftung legend legende""",
    Class.FACTOR: """
        per
        encoder enc resolution aufloesung cpr ppr gain gains verstaerkung
        scale scaling factor factors faktor faktoren facteur facteurs fattore fator escala echelle
        skala skalierung massstab multiplier multiplikator scalefactor""",
    Class.GEAR: """
        gear gears gearratio gearing getriebe getriebeuebersetzung uebersetzung uebersetzungen
        reduction reducteur reduccion riduzione reducao ratio untersetzung transmission ng""",
    Class.MOTOR: "motor motors motorseitig moteur moteurs motore motori motores antrieb rotor",
    Class.GRIPPER: """
        gripper greifer grip grippers gripperstate gripperpos hand finger fingers jaw jaws claw
        schliessen greiferzustand greiferposition zange vacuum suction saugnapf sauger robotiq
        closed geschlossen pince prehenseur garra pinza pinca mano ventouse chwytak zhuazi
        jiazhua tutucu grijper захват 夹爪 グリッパー""",
    Class.ADMIN: """
        author authors autor autores auteur autore auteurs ersteller bearbeiter created creator
        creation date datum datums fecha datas erstellt stand operator user benutzer student
        studenten etudiant file filename datei dateiname fichier archivo bestand
        lab labor course kurs institute institut university licence license lizenz host software
        program programm script skript language sprache uuid topic path folder ordner url email
        project projekt proyecto projet progetto projeto matlab toolbox toolversion
        version release serial""",
    Class.TABLE: """
        mass masse masa massa weight gewicht payload traglast charge carga carico length laenge
        longueur largo lunghezza width breite height hoehe radius kp ki kd tol tolerance
        toleranz eps limit limits lim lims min max lower upper grenze grenzen limite limites
        seed id version number anzahl nombre numero num n count counts
        dof dofs ndof nq nj joints joint gravity g temperature index trial year month day date
        serial size points steps iterations iter maxiter damping friction stiffness inertia alpha
        beta gamma k score cost error success episode episodes port m l a d mu rho""",
}

# the quantities are those of diagnostics.QUANTITY
QUANTITIES = {
    "velocities": """
        vel vels velocity velocities speed speeds dot d1 qd dq qp qv vq qdot dth dtheta dthetas
        dphi thetad thetadot thetap phid phip geschw geschwindigkeit geschwindigkeiten omega
        omegas w rpm drehrate drehzahl drehzahlen velocidad velocidades vitesse vitesses velocita
        velocidade velocidades snelheid snelheden predkosc predkosci hiz hizi sudu sokudo rychlost
        скорость скорости 速度 속도 twist qdots thd punkt winkelgeschw""",
    "accelerations": """
        acc accs accel accels acceleration accelerations ddot d2 qdd ddq qpp qddot beschleunigung
        beschleunigungen aceleracion aceleraciones acceleration accelerazione accelerazioni
        aceleracao aceleracoes versnelling przyspieszenie przyspieszenia ivme jiasudu kasokudo
        zrychleni ускорение 加速度 가속도 ddth ddtheta ddphi thetadd phidd phipp beschl""",
    "jerks": "jerk jerks d3 d4 ruck rucke jolt secousse tiron strappo",
    "torques": """
        torque torques force forces tau taus wrench moment moments momente load loads effort
        efforts ft trq mom kraft kraefte drehmoment drehmomente gelenkmoment gelenkmomente
        achsmoment pares momenti esfuerzo esfuerzos sforzo sforzi esforco esforcos
        binario binarios binari niuju 扭力
        couple couples fuerza fuerzas forza forze coppia coppie torque forca forcas koppel
        krachten moment momenty tork kuvvet liju torsi toruku момент моменты сила усилие
        力矩 扭矩 トルク 토크 momento momentos effort""",
    "currents": """
        currents amps ampere amperes strom stroeme motorstrom motorstroeme gelenkstrom achsstrom
        courant courants corriente corrientes corrente correnti correntes stroom prad prady akim
        dianliu denryuu intensite intensites intensidad intensidades intensita intensidade
        proud proudy ток токи 电流 電流 전류 iq id imot""",
    "voltages": """
        voltage voltages volt volts pwm spannung spannungen tension tensions tensione tensioni
        voltaje voltajes tensao tensoes dianya denatsu napiecie gerilim напряжение 电压 電圧""",
    "errors": """
        error errors err errs deviation deviations residual residuals diff diffs difference
        differences delta deltas fehler abweichung abweichungen differenz regelabweichung
        regelfehler schleppfehler residuum erreur erreurs ecart ecarts errore errori scarto erro
        erros desvio fout fouten blad bledy hata wucha gosa chyba ошибка ошибки 误差 誤差 오차
        tilde noise rauschen""",
    "poses": """
        tcp poses cartesian cart xyz rpy quat quats quaternion quaternions eef ee endeffector
        endeffektor tool toolpath toolvector workspace xyzrpy xyzabc kartesisch kartesische
        werkzeug shisei effecteur outil herramienta utensile ferramenta cartesien cartesienne
        cartesiano cartesiana gereedschap narzedzie kartezyen cpath ctraj tpose tcppos cpol euler
        orientation orientierung flange flansch quaternionen mocap marker""",
    "times": "tspan",
    "parameters": """
        limit limits inertia gains gain jacobian covariance coefficients jacobi jac dh qlim
        mask cov weights bounds dhparams dhtable verstaerkung grenzwert grenzwerte gravity""",
    "temperatures": """
        temp temperature temperatures temperatur temperaturen temperatura temperaturas
        temperature sicaklik wendu ondo teplota температура 温度 온도""",
    "obstacles": "obs obst obstacle obstacles hindernis hindernisse",
}

# whole names that are given to joint positions and as often to something else
TWO_MEANINGS = {
    "qd": "joint_velocities",
    "qobs": "obstacles",
    "qerr": "errors",
    "qerror": "errors",
    "u": "inputs",
    "v": "pixels",
    "x": "tool_or_states",
    "p": "points",
    "s": "states_or_path",
    "w": "angular_velocities",
    "state": "states",
    "states": "states",
    "b": "parameters",
}
# whole names that mean one thing
ONE_MEANING = {
    "times": "t time tout times zeit timestamp timestamps tspan",
    "torques": "f tau",
    "currents": "i current",
    "errors": "e",
    "poses": "pose xd xdd xe xc xr xref xdes xact ee cart pose",
    "parameters": "k j m g dh kp kd ki",
    "accelerations": "qa acc",
    "velocities": "omega w",
}
# what joints are called where each has a column or a variable of its own: A1 to A6
NUMBERED = (
    "q th theta thetas j jnt joint joints a axis achse achsen gelenk gelenke winkel phi angle "
)
NUMBERED += (
    "angles eje articulacion articulation axe giunto asse junta eixo jiku guanjie os przegub s e"
)
# a letter beside a symbol: another quantity before it, a role or an index behind it
BEFORE_SYMBOL = {
    "v": "velocities",
    "e": "errors",
    "a": "accelerations",
    "t": "torques",
    "tau": "torques",
    "d": "errors",
    "i": "currents",
}
AFTER_SYMBOL = {"v": "velocities", "a": "accelerations", "e": "errors", "p": "velocities"}
ROLE_LETTERS = "d r c s f k j i n t l x1 b"

# makers and families of robots, with the words that say them
ROBOTS = {
    "universal robots": "ur ur3 ur5 ur7 ur8 ur10 ur12 ur15 ur16 ur18 ur20 ur30 ur3e ur5e ur7e "
    "ur8long ur10e ur12e ur16e cb3",
    "kuka": "kuka kr lbr iiwa iisy kr3 kr4 kr5 kr6 kr10 kr16 kr20 kr30 kr50 kr60 kr70 kr90 kr120 "
    "kr150 kr180 kr210 kr240 kr270 kr300 kr360 kr500 kr560 kr1000 agilus cybertech quantec "
    "fortec titan youbot",
    "franka": "franka panda fr3 emika",
    "abb": "abb irb irb120 irb140 irb1200 irb1600 irb2400 irb4600 irb6640 yumi gofa",
    "fanuc": "fanuc lrmate m10 m20 r2000 crx",
    "yaskawa": "yaskawa motoman gp7 gp8 gp12 hc10",
    "staubli": "staubli tx60 tx90 tx2 rx160",
    "kinova": "kinova jaco jaco2 gen3 mico",
    "doosan": "doosan m0609 m1013 m1509 h2515",
    "techman": "techman tm5 tm12",
    "ufactory": "ufactory xarm xarm5 xarm6 xarm7 lite6",
    "denso": "denso vs060 vs087 vp6242 cobotta",
    "puma": "puma puma560 p560 unimation",
    "comau": "comau racer5 nj16 smart",
    "nachi": "nachi mz07",
    "rethink": "rethink sawyer baxter",
    "other": "stanford scara aubo elfin dobot mg400 cr5 magician elephant mycobot niryo "
    "braccio viperx widowx trossen interbotix so100 so101 koch aloha gen2 spot nao pepper atlas "
    "wam barrett schunk lwa mitsubishi epson omron hanwha neuromeka indy7 rainbow flexiv rizon "
    "agilex piper",
}

# words of texts that say nothing of numbers; they do not explain a name
_PROSE = """
    a an and are as at be by for from has have i if in into is it its of on or our over per so
    that the their then there these they this those to was we were while with without one two
    three each every during before after up down pick place picking placing grasp grasping
    welding painting pouring stacking demo lab test experiment exercise lesson course student
    teacher class group task job work cell table box cube ball part object workpiece circle
    line square cycle morning good bad ok yes no new old slow fast smooth simple made generated
    created exported recorded written saved computed taken using used by matlab octave python
    simulink simulation robotics toolbox ros rtde script function version program file der die
    das ein eine einer eines im in am an auf aus bei mit ohne von vom zu zum zur und oder fuer
    ist sind war wurde werden aufgenommen erzeugt erstellt gespeichert berechnet labor versuch
    uebung aufgabe greifen ablegen schweissen teil wuerfel kreis gerade bewegung des dem den
    alle le la les un une des du de d l en et ou pour avec sans sur dans par est sont tp essai
    prise depose enregistre calcule genere toutes tous chaque el los las una unos y o con sin
    por para del al es son ensayo prueba laboratorio tomar dejar grabado calculado generado
    cada il lo gli uno e ed con senza per di del della dei delle prova registrato calcolato
    generato ogni presa os as um uma com sem pelo pela dos das ensaio prova gravado calculado
    gerado cada het een van met zonder voor en of door bij proef opgenomen berekend gegenereerd
    elke
    """
PROSE = frozenset(_PROSE.split())

# words that say what may still have to be done to a motion; they do not explain a name
_PENDING = """
    flip flipped flipud fliplr mirror mirrored mirroring invert inverted inverse reverse reversed
    negate swap swapped relative incremental increment increments delta deltas interp interpolate
    interpolation upsample downsample upsampling downsampling decimate decimation stride unwrap
    rotate offset shift spiegeln gespiegelt spiegel spiegelung invertieren invertiert umkehren
    umgekehrt rueckwaerts relativ inkrementell miroir inverser inversee relatif
    incrementale espejo invertir invertido invertida relativo relativa specchio speculare
    invertito invertita espelho inverso
    """
PENDING = frozenset(_PENDING.split())
# of data beside a motion whose rates are not its own
_FOREIGN = """
    controller regler filter cutoff emg eeg cam camera kamera camara fotocamera force kraft ft imu
    audio plot video mocap optitrack vicon lidar mic microphone mikrofon sound forces torque
    webcam gopro realsense kinect timeout sine sinus excitation
    """
FOREIGN = frozenset(_FOREIGN.split())
# words of flags of a program that change no numbers
_QUIET = "debug verbose plot plots plotting show display print animate figure gui on save"
QUIET = frozenset(_QUIET.split())
