import com.eteks.sweethome3d.io.DefaultFurnitureCatalog;
import com.eteks.sweethome3d.io.DefaultUserPreferences;
import com.eteks.sweethome3d.io.HomeFileRecorder;
import com.eteks.sweethome3d.model.CatalogPieceOfFurniture;
import com.eteks.sweethome3d.model.DoorOrWindow;
import com.eteks.sweethome3d.model.FurnitureCategory;
import com.eteks.sweethome3d.model.Home;
import com.eteks.sweethome3d.model.HomeDescriptor;
import com.eteks.sweethome3d.model.HomeDoorOrWindow;
import com.eteks.sweethome3d.model.HomeFurnitureGroup;
import com.eteks.sweethome3d.model.HomeLight;
import com.eteks.sweethome3d.model.HomePieceOfFurniture;
import com.eteks.sweethome3d.model.Level;
import com.eteks.sweethome3d.model.Light;
import com.eteks.sweethome3d.model.Room;
import com.eteks.sweethome3d.model.UserPreferences;
import com.eteks.sweethome3d.swing.SwingViewFactory;
import com.eteks.sweethome3d.tools.URLContent;
import com.eteks.sweethome3d.viewcontroller.PlanController;
import java.io.File;
import java.nio.file.Files;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import javax.swing.undo.UndoableEditSupport;

/**
 * Draws the homes of a folder of descriptions in Sweet Home 3D: walls and rooms by clicks of its mouse, pieces
 * of its own catalogue dragged to where they snap.
 *
 * Usage: java -cp ... Make.java FROM TO for each FROM/NAME.txt, or java -cp ... Make.java --examples TO for the
 * homes that Sweet Home 3D has as examples. README.md says what a description is.
 */
public class Make {
    private static final Pattern WORD = Pattern.compile("(\\w+=)?\"([^\"]*)\"|\\S+");

    private final Map<String, CatalogPieceOfFurniture> catalog = new HashMap<>();
    private final UserPreferences preferences = new DefaultUserPreferences();
    private final Home home = new Home();
    private final Hand hand;
    private List<HomePieceOfFurniture> group;
    private String groupName;

    public static void main(String[] said) throws Exception {
        if (said[0].equals("--examples")) {
            examples(new File(said[1]));
            System.exit(0);
        }
        File[] files = new File(said[0]).listFiles((folder, name) -> name.endsWith(".txt"));
        Arrays.sort(files);
        for (File file : files) {
            Make make = new Make();
            int number = 0;
            for (String line : Files.readAllLines(file.toPath())) {
                number++;
                try {
                    make.line(line);
                } catch (RuntimeException error) {
                    throw new IllegalArgumentException(file.getName() + ":" + number + ": " + line, error);
                }
            }
            String name = file.getName().replaceAll("\\.txt$", ".sh3d");
            new HomeFileRecorder(9, false, make.preferences, false, true)
                .writeHome(make.home, new File(said[1], name).getPath());
        }
        System.exit(0);
    }

    private Make() {
        hand = new Hand(home, preferences);
        language("en");
    }

    /** One line of a description. */
    private void line(String line) {
        List<String> words = new ArrayList<>();
        Matcher matcher = WORD.matcher(line.replaceAll("(^|\\s)#.*", ""));
        while (matcher.find()) {
            String key = matcher.group(1) == null ? "" : matcher.group(1);
            words.add(matcher.group(2) == null ? matcher.group() : key + matcher.group(2));
        }
        if (words.isEmpty()) {
            return;
        }
        List<String> rest = words.subList(1, words.size());
        switch (words.get(0)) {
            case "language" -> language(rest.get(0));
            case "latitude" -> home.getCompass().setLatitude((float) Math.toRadians(number(rest.get(0))));
            case "level" -> level(rest.get(0), number(rest.get(1)), number(rest.get(2)));
            case "wall" -> walls(number(rest.get(0)), 0, rest.subList(1, rest.size()));
            case "arc" -> walls(number(rest.get(0)), number(rest.get(1)), rest.subList(2, rest.size()));
            case "room" -> hand.room(rest.get(0), point(rest.get(1)));
            case "outline" -> outline(rest.get(0), rest.subList(1, rest.size()));
            case "group" -> {
                group = new ArrayList<>();
                groupName = rest.get(0);
            }
            case "end" -> {
                home.addPieceOfFurniture(new HomeFurnitureGroup(group, 0, false, groupName));
                group = null;
            }
            default -> piece(words.get(0), point(rest.get(0)), rest.subList(1, rest.size()));
        }
    }

    private void language(String language) {
        preferences.setLanguage(language);
        for (FurnitureCategory category : new DefaultFurnitureCatalog(preferences, (File) null).getCategories()) {
            category.getFurniture().forEach(piece -> catalog.put(piece.getId(), piece));
        }
    }

    private void level(String name, float elevation, float height) {
        Level level = new Level(name, elevation, 12, height);
        home.addLevel(level);
        home.setSelectedLevel(level);
    }

    private void walls(float thickness, float arcDegrees, List<String> points) {
        preferences.setNewWallThickness(thickness);
        int before = home.getWalls().size();
        hand.walls(points.stream().map(Make::point).toList());
        if (arcDegrees != 0) {
            home.getWalls().stream().skip(before)
                .forEach(wall -> wall.setArcExtent((float) Math.toRadians(arcDegrees)));
        }
    }

    private void outline(String name, List<String> points) {
        Room room = new Room(points.stream().map(Make::point).toArray(float[][]::new));
        room.setName(name);
        room.setAreaVisible(true);
        home.addRoom(room);
    }

    private void piece(String id, float[] at, List<String> options) {
        CatalogPieceOfFurniture of = catalog.get("eTeks#" + id);
        HomePieceOfFurniture piece = of instanceof DoorOrWindow ? new HomeDoorOrWindow((DoorOrWindow) of)
            : of instanceof Light ? new HomeLight((Light) of)
            : new HomePieceOfFurniture(of);
        boolean isFree = group != null;
        for (String option : options) {
            String[] pair = option.split("=", 2);
            switch (pair[0]) {
                case "name" -> piece.setName(pair[1]);
                case "up" -> piece.setElevation(number(pair[1]));
                case "size" -> {
                    String[] sizes = pair[1].split("x");
                    piece.setWidth(number(sizes[0]));
                    piece.setDepth(number(sizes[1]));
                    piece.setHeight(number(sizes[2]));
                    piece.setWidthInPlan(piece.getWidth());
                    piece.setDepthInPlan(piece.getDepth());
                    piece.setHeightInPlan(piece.getHeight());
                }
                case "turn" -> {
                    piece.setAngle((float) Math.toRadians(number(pair[1])));
                    isFree = true;
                }
                case "mirror" -> piece.setModelMirrored(true);
                case "hide" -> piece.setVisible(false);
                case "unknown" -> piece.setCatalogId(null);
                case "free" -> isFree = true;
                default -> throw new IllegalArgumentException(option);
            }
        }
        piece.setX(at[0]);
        piece.setY(at[1]);
        if (group != null) {
            group.add(piece);
            return;
        }
        home.addPieceOfFurniture(piece);
        if (!isFree) {
            hand.snap(piece, at[0], at[1]);
        }
    }

    private static float[] point(String text) {
        String[] pair = text.split(",");
        return new float[] {number(pair[0]), number(pair[1])};
    }

    private static float number(String text) {
        return Float.parseFloat(text);
    }

    /** The hand of a person who draws: what it does is done by Sweet Home 3D's own control of the plan. */
    private static class Hand extends PlanController {
        private final Home home;

        Hand(Home home, UserPreferences preferences) {
            super(home, preferences, new SwingViewFactory(), null, new UndoableEditSupport());
            this.home = home;
        }

        /** Clicks along walls, the last one a double click. */
        void walls(List<float[]> points) {
            setMode(Mode.WALL_CREATION);
            points.forEach(this::click);
            press(points.get(points.size() - 1), 2);
            setMode(Mode.SELECTION);
        }

        /** A double click inside of walls. */
        void room(String name, float[] at) {
            int before = home.getRooms().size();
            setMode(Mode.ROOM_CREATION);
            click(at);
            press(at, 2);
            setMode(Mode.SELECTION);
            if (home.getRooms().size() != before + 1) {
                throw new IllegalArgumentException("no walls are around it");
            }
            home.getRooms().get(before).setName(name.isEmpty() ? null : name);
        }

        void snap(HomePieceOfFurniture piece, float x, float y) {
            adjustMagnetizedPieceOfFurniture(piece, x, y);
        }

        private void click(float[] at) {
            moveMouse(at[0], at[1]);
            press(at, 1);
        }

        private void press(float[] at, int count) {
            pressMouse(at[0], at[1], count, false, false);
            releaseMouse(at[0], at[1]);
        }
    }

    /** Saves the homes that "File > New from demo" offers. */
    private static void examples(File to) throws Exception {
        UserPreferences preferences = new DefaultUserPreferences();
        HomeFileRecorder recorder = new HomeFileRecorder(9, false, preferences, false, true, true);
        for (HomeDescriptor example : preferences.getHomeExamples()) {
            Home home = recorder.readHome(((URLContent) example.getContent()).getURL().toString());
            recorder.writeHome(home, new File(to, example.getName() + ".sh3d").getPath());
        }
    }
}
